//! Trace of a run: a row a frame and block, as Parquet, CSV or JSON lines.

mod parquet;
mod row;

use std::io::{self, Write};
use std::path::Path;

use teeter_physics::World;
use teeter_report::OutFile;
use teeter_scene::Scene;

use crate::error::Error;
use crate::output;
use parquet::ParquetTable;
use row::Row;

/// Trace that is written while a world runs.
pub struct Trace {
    table: Table,
    name: String,
    /// Ids of the blocks in the order of the bodies.
    ids: Vec<u32>,
    /// Frames from a row of a block to its next.
    every: u64,
    /// Frames recorded or passed over.
    frame: u64,
}

/// Table in the format of the file.
enum Table {
    Parquet(Box<ParquetTable>),
    Csv(Box<csv::Writer<OutFile>>),
    JsonLines(OutFile),
}

impl Trace {
    /// Creates the file. Its extension gives the format. A row is written every `every` frames.
    pub fn create(path: &Path, scene: &Scene, world: &World, every: u64) -> Result<Self, Error> {
        let name = path.display().to_string();
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
        let kind = match extension.as_deref() {
            Some(kind @ ("parquet" | "csv" | "jsonl")) => kind,
            _ => return Err(Error::TraceFormat { name }),
        };
        let file = OutFile::create(path).map_err(|source| Error::Create { name: name.clone(), source })?;
        let table = match kind {
            "csv" => Table::Csv(Box::new(csv::Writer::from_writer(file))),
            "jsonl" => Table::JsonLines(file),
            _ => {
                let notes = notes(scene, world, every);
                let table = ParquetTable::new(file, notes);
                Table::Parquet(Box::new(table.map_err(|source| Error::Write { name: name.clone(), source })?))
            }
        };
        let ids = scene.blocks.iter().map(|block| block.id).collect();
        Ok(Self { table, name, ids, every, frame: 0 })
    }

    /// Records the state at the start of the run, or after a frame.
    pub fn record(&mut self, world: &World) -> Result<(), Error> {
        let due = self.frame.is_multiple_of(self.every);
        self.frame += 1;
        if !due {
            return Ok(());
        }
        let Self { table, ids, .. } = self;
        let mut rows = world.bodies().zip(ids.iter()).map(|(body, &id)| Row::new(world, body, id));
        rows.try_for_each(|row| table.write(&row)).map_err(|source| self.error(source))
    }

    /// Writes the rest, and gives the file its name.
    pub fn finish(self) -> Result<(), Error> {
        self.table.finish().map_err(|source| Error::Write { name: self.name, source })
    }

    fn error(&self, source: io::Error) -> Error {
        Error::Write { name: self.name.clone(), source }
    }
}

impl Table {
    fn write(&mut self, row: &Row) -> io::Result<()> {
        match self {
            Self::Parquet(table) => table.write(row),
            Self::Csv(table) => table.serialize(row).map_err(io::Error::from),
            Self::JsonLines(file) => writeln!(file, "{}", output::to_json(row)),
        }
    }

    fn finish(self) -> io::Result<()> {
        match self {
            Self::Parquet(table) => table.finish()?.finish(),
            Self::Csv(table) => table.into_inner().map_err(csv::IntoInnerError::into_error)?.finish(),
            Self::JsonLines(file) => file.finish(),
        }
    }
}

/// Metadata of a trace: keys and values.
fn notes(scene: &Scene, world: &World, every: u64) -> Vec<(&'static str, String)> {
    let frame = world.params().frame;
    vec![
        ("scene", scene.name.clone()),
        ("teeter_version", env!("CARGO_PKG_VERSION").to_owned()),
        ("frame_s", frame.to_string()),
        ("substep_s", world.substep().to_string()),
        ("dt_s", (frame * every as f64).to_string()),
    ]
}
