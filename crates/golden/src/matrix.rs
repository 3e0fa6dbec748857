//! The matrix: every build and way to run, against every run.

use std::fmt::Write;

use crate::Golden;
use crate::runs::Outcome;

/// What came of one run in one build and way to run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cell {
    /// The build and way to run.
    pub column: String,
    /// Name of the run.
    pub run: String,
    /// What came of it.
    pub outcome: Outcome,
}

impl Cell {
    /// As a line: column, run, step of rest (`-` for none) and hash, with tabs between.
    pub fn line(&self) -> String {
        let rest = self.outcome.step_of_rest.map_or("-".to_owned(), |step| step.to_string());
        format!("{}\t{}\t{rest}\t{}", self.column, self.run, self.outcome.hash)
    }

    /// From such a line.
    pub fn parse(line: &str) -> Option<Self> {
        let mut fields = line.split('\t');
        let (column, run, rest, hash) = (fields.next()?, fields.next()?, fields.next()?, fields.next()?);
        let step_of_rest = if rest == "-" { None } else { Some(rest.parse().ok()?) };
        Some(Self {
            column: column.to_owned(),
            run: run.to_owned(),
            outcome: Outcome { step_of_rest, hash: hash.to_owned() },
        })
    }
}

/// The matrix for reading, and whether every cell is there and equal to the golden result. A cell that differs shows what it gave.
pub fn table(golden: &Golden, cells: &[Cell]) -> (String, bool) {
    let mut columns: Vec<&str> = Vec::new();
    for cell in cells {
        if !columns.contains(&cell.column.as_str()) {
            columns.push(&cell.column);
        }
    }
    let mut out = String::new();
    let mut all = !cells.is_empty();
    let mut row = |head: &str, fields: &mut dyn Iterator<Item = &str>| {
        write!(out, "{head:26}").expect("a string takes all");
        fields.for_each(|field| write!(out, "  {field:16}").expect("a string takes all"));
        out.truncate(out.trim_end().len());
        out.push('\n');
    };
    row("", &mut golden.runs.iter().map(|run| run.name.as_str()));
    row("golden", &mut golden.runs.iter().map(|run| run.outcome.hash.as_str()));
    let rests: Vec<String> = golden
        .runs
        .iter()
        .map(|run| run.outcome.step_of_rest.map_or("awake".to_owned(), |s| format!("rests at {s}")))
        .collect();
    row("", &mut rests.iter().map(String::as_str));
    for column in columns {
        let fields: Vec<&str> = golden
            .runs
            .iter()
            .map(|run| match cells.iter().find(|cell| cell.column == column && cell.run == run.name) {
                Some(cell) if cell.outcome == run.outcome => "equal",
                Some(cell) if cell.outcome.hash == run.outcome.hash => "other rest",
                Some(cell) => &cell.outcome.hash,
                None => "missing",
            })
            .collect();
        all &= fields.iter().all(|&field| field == "equal");
        row(column, &mut fields.into_iter());
    }
    (out, all)
}
