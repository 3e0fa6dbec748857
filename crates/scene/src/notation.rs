//! Notation of section 6.1 of the dissertation: (010)-(010)-(011), bottom row first, columns 0, 1
//! and 2 from left to right.

use std::fmt;
use std::str::FromStr;

use crate::error::SceneError;

/// Maximum number of rows of a tower.
pub const MAX_ROWS: u32 = 200;

/// Cell of a row.
///
/// ```
/// use teeter_scene::{Cell, Notation};
///
/// let notation: Notation = "(01L)".parse()?;
/// assert_eq!(notation.rows[0], [Cell::Absent, Cell::Present, Cell::Loose]);
/// # Ok::<(), teeter_scene::SceneError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cell {
    /// No block, `0`.
    Absent,
    /// Block, `1`.
    Present,
    /// Block lower than the others by [`LOOSE_CLEARANCE`](crate::LOOSE_CLEARANCE), `L`; it carries
    /// nothing.
    Loose,
}

/// Blocks of a tower, row by row.
///
/// `(010)-(1L1)` has no block at `0`, a block at `1` and a loose block at `L`. Every row has at
/// least one block, because an empty row cannot carry the next. The dissertation's maps of loose
/// blocks use `0` differently, see [`Notation::from_loose_map`].
///
/// ```
/// use teeter_scene::Notation;
///
/// let notation: Notation = "(010)-(1l1)".parse()?;
/// assert_eq!(notation.to_string(), "(010)-(1L1)");
/// # Ok::<(), teeter_scene::SceneError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Notation {
    /// Rows, bottom row first.
    pub rows: Vec<[Cell; 3]>,
}

impl Notation {
    /// Parses a map of loose blocks such as `(L00)-(00L)`: a full tower where `L` is a loose block
    /// and `0` an ordinary one.
    ///
    /// # Errors
    /// Names the first row that is not three of `0` and `L` in brackets.
    pub fn from_loose_map(text: &str) -> Result<Self, SceneError> {
        let expected = "three of 0 (ordinary) and L (loose) in brackets, such as (0L0)";
        Ok(Self {
            rows: parse_rows(text, expected, |c| match c {
                '0' => Some(Cell::Present),
                'L' | 'l' => Some(Cell::Loose),
                _ => None,
            })?,
        })
    }
}

impl FromStr for Notation {
    type Err = SceneError;

    fn from_str(text: &str) -> Result<Self, SceneError> {
        let expected = "three of 0 (none), 1 (block) and L (loose block) in brackets, such as (011)";
        let rows = parse_rows(text, expected, |c| match c {
            '0' => Some(Cell::Absent),
            '1' => Some(Cell::Present),
            'L' | 'l' => Some(Cell::Loose),
            _ => None,
        })?;
        for (i, row) in rows.iter().enumerate() {
            if row == &[Cell::Absent; 3] {
                return Err(SceneError::Notation {
                    row: i + 1,
                    text: "(000)".into(),
                    expected: "at least one block in every row",
                });
            }
        }
        Ok(Self { rows })
    }
}

impl fmt::Display for Notation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, row) in self.rows.iter().enumerate() {
            f.write_str(if i == 0 { "(" } else { "-(" })?;
            for cell in row {
                f.write_str(match cell {
                    Cell::Absent => "0",
                    Cell::Present => "1",
                    Cell::Loose => "L",
                })?;
            }
            f.write_str(")")?;
        }
        Ok(())
    }
}

fn parse_rows(
    text: &str,
    expected: &'static str,
    cell: impl Fn(char) -> Option<Cell>,
) -> Result<Vec<[Cell; 3]>, SceneError> {
    let mut rows = Vec::new();
    for (i, part) in text.split('-').enumerate() {
        let part = part.trim();
        let error = |expected| SceneError::Notation { row: i + 1, text: truncate(part), expected };
        if i as u32 >= MAX_ROWS {
            return Err(error("at most 200 rows"));
        }
        let inner = part.strip_prefix('(').and_then(|p| p.strip_suffix(')')).ok_or_else(|| error(expected))?;
        let cells: Vec<Cell> =
            inner.chars().take(4).map(&cell).collect::<Option<_>>().ok_or_else(|| error(expected))?;
        rows.push(cells.try_into().map_err(|_| error(expected))?);
    }
    Ok(rows)
}

/// Truncates a text of any length for an error message.
fn truncate(text: &str) -> String {
    const MAX: usize = 20;
    if text.chars().count() <= MAX { text.to_owned() } else { text.chars().take(MAX).chain("...".chars()).collect() }
}
