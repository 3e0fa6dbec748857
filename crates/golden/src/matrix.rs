//! Matrix of builds and modes against runs.

use std::fmt::Write;

use crate::results::Golden;
use crate::runs::Outcome;

/// Outcome of one run in one build and mode.
///
/// ```
/// use teeter_golden::Cell;
///
/// let cell = Cell::parse("release, sse2\tmidgame\t-\t0123456789abcdef").expect("four fields");
/// assert_eq!((cell.run.as_str(), cell.outcome.step_of_rest), ("midgame", None));
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cell {
    /// Build and mode.
    pub column: String,
    /// Name of the run.
    pub run: String,
    /// Outcome of the run.
    pub outcome: Outcome,
}

impl Cell {
    /// Formats the cell as a line: column, run, step of rest (`-` for none) and hash, separated by
    /// tabs.
    pub fn line(&self) -> String {
        let rest = self.outcome.step_of_rest.map_or("-".to_owned(), |step| step.to_string());
        format!("{}\t{}\t{rest}\t{}", self.column, self.run, self.outcome.hash)
    }

    /// Parses a line of [`Cell::line`].
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

/// Formats the matrix, and returns true with it if every cell is present and equal to the golden
/// result. A cell that differs shows its hash.
pub fn table(golden: &Golden, cells: &[Cell]) -> (String, bool) {
    let mut columns: Vec<&str> = Vec::new();
    for cell in cells {
        if !columns.contains(&cell.column.as_str()) {
            columns.push(&cell.column);
        }
    }
    let mut out = String::new();
    let mut equal = !cells.is_empty();
    let mut row = |head: &str, fields: &mut dyn Iterator<Item = &str>| {
        write!(out, "{head:26}").expect("writing to a string does not fail");
        fields.for_each(|field| write!(out, "  {field:16}").expect("writing to a string does not fail"));
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
        equal &= fields.iter().all(|&field| field == "equal");
        row(column, &mut fields.into_iter());
    }
    (out, equal)
}
