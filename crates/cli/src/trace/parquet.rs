//! Trace as Parquet.

use std::io;
use std::sync::Arc;

use parquet::basic::{Compression, Encoding, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{BoolType, DataType, DoubleType, Int32Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{ColumnPath, Type};
use teeter_report::OutFile;

use super::row::{FLAGS, ID, NUMBERS, Row};

/// Rows of a row group, which are in memory until it is full: 8 MB.
const ROW_GROUP: usize = 1 << 16;

/// Rows as columns, a row group at a time.
pub struct ParquetTable {
    writer: SerializedFileWriter<OutFile>,
    ids: Vec<i32>,
    numbers: [Vec<f64>; NUMBERS.len()],
    flags: [Vec<bool>; FLAGS.len()],
}

impl ParquetTable {
    /// Begins a table with metadata, keys and values.
    pub fn new(file: OutFile, notes: Vec<(&'static str, String)>) -> io::Result<Self> {
        let notes = notes.into_iter().map(|(key, value)| KeyValue::new(key.to_owned(), value)).collect();
        let mut properties = WriterProperties::builder()
            .set_created_by(format!("teeter version {}", env!("CARGO_PKG_VERSION")))
            .set_key_value_metadata(Some(notes))
            .set_compression(Compression::SNAPPY);
        // All rows of a frame have the same time. Other numbers hardly ever repeat: split into
        // bytes of the same significance they compress.
        for name in &NUMBERS[1..] {
            let path = ColumnPath::from(*name);
            properties = properties
                .set_column_dictionary_enabled(path.clone(), false)
                .set_column_encoding(path, Encoding::BYTE_STREAM_SPLIT);
        }
        let schema = schema().map_err(error)?;
        let writer = SerializedFileWriter::new(file, Arc::new(schema), Arc::new(properties.build())).map_err(error)?;
        let (numbers, flags) = Default::default();
        Ok(Self { writer, ids: Vec::new(), numbers, flags })
    }

    /// Appends a row.
    pub fn write(&mut self, row: &Row) -> io::Result<()> {
        // The bits of an unsigned number, as its logical type says.
        self.ids.push(row.id.cast_signed());
        self.numbers.iter_mut().zip(row.numbers).for_each(|(column, value)| column.push(value));
        self.flags.iter_mut().zip(row.flags).for_each(|(column, value)| column.push(value));
        if self.ids.len() < ROW_GROUP { Ok(()) } else { self.write_row_group().map_err(error) }
    }

    /// Writes the last row group and the footer, and returns the file.
    pub fn finish(mut self) -> io::Result<OutFile> {
        if !self.ids.is_empty() {
            self.write_row_group().map_err(error)?;
        }
        self.writer.into_inner().map_err(error)
    }

    fn write_row_group(&mut self) -> Result<(), ParquetError> {
        let mut group = self.writer.next_row_group()?;
        let (time, others) = self.numbers.split_at_mut(1);
        write_column::<DoubleType>(&mut group, &mut time[0])?;
        write_column::<Int32Type>(&mut group, &mut self.ids)?;
        others.iter_mut().try_for_each(|column| write_column::<DoubleType>(&mut group, column))?;
        self.flags.iter_mut().try_for_each(|column| write_column::<BoolType>(&mut group, column))?;
        group.close().map(drop)
    }
}

/// Writes a column and clears it.
fn write_column<T: DataType>(
    group: &mut SerializedRowGroupWriter<OutFile>,
    values: &mut Vec<T::T>,
) -> Result<(), ParquetError> {
    let mut column = group.next_column()?.ok_or_else(|| ParquetError::General("too many columns".into()))?;
    column.typed::<T>().write_batch(values, None, None)?;
    values.clear();
    column.close()
}

/// Columns in the order of a row's fields.
fn schema() -> Result<Type, ParquetError> {
    let column = |name: &str, physical, logical| {
        let builder = Type::primitive_type_builder(name, physical).with_repetition(Repetition::REQUIRED);
        builder.with_logical_type(logical).build().map(Arc::new)
    };
    let mut columns = vec![
        column(NUMBERS[0], Physical::DOUBLE, None)?,
        column(ID, Physical::INT32, Some(LogicalType::integer(32, false)))?,
    ];
    for name in &NUMBERS[1..] {
        columns.push(column(name, Physical::DOUBLE, None)?);
    }
    for name in FLAGS {
        columns.push(column(name, Physical::BOOLEAN, None)?);
    }
    Type::group_type_builder("trace").with_fields(columns).build()
}

fn error(error: ParquetError) -> io::Error {
    match error {
        ParquetError::External(cause) => io::Error::other(cause),
        error => io::Error::other(error),
    }
}
