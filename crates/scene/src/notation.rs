//! The notation of the dissertation's section 6.1: (010)-(010)-(011), bottom row first, columns 0, 1, 2 from left to right.

use std::fmt;
use std::str::FromStr;

use crate::tower::{self, MAX_ROWS};
use crate::{Scene, SceneError, TowerOptions};

/// What is in one place of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cell {
    /// Nothing; written 0.
    Absent,
    /// A block; written 1.
    Present,
    /// A block that is lower than the others by [`tower::LOOSE_BY`], and carries nothing; written L.
    Loose,
}

/// Which blocks of a tower are there.
///
/// Parsed from `(010)-(1L1)`: 1 is a block, 0 is none, `L` is a loose block. Every row has at least one block, for a row of none cannot carry the
/// next. The dissertation's maps of loose blocks use 0 in another sense: see [`Notation::from_loose_map`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Notation {
    /// Rows, bottom row first.
    pub rows: Vec<[Cell; 3]>,
}

impl Notation {
    /// A full tower of which `(L00)-(00L)` names the loose blocks: `L` is a loose block and 0 an ordinary one.
    pub fn from_loose_map(text: &str) -> Result<Self, SceneError> {
        let expected = "three of 0 (ordinary) and L (loose) in brackets, such as (0L0)";
        Ok(Self {
            rows: split(text, expected, |c| match c {
                '0' => Some(Cell::Present),
                'L' | 'l' => Some(Cell::Loose),
                _ => None,
            })?,
        })
    }

    /// The tower of these blocks.
    pub fn scene(&self, options: &TowerOptions) -> Result<Scene, SceneError> {
        tower::build(&self.to_string(), &self.rows, options)
    }
}

impl FromStr for Notation {
    type Err = SceneError;

    fn from_str(text: &str) -> Result<Self, SceneError> {
        let expected = "three of 0 (none), 1 (block) and L (loose block) in brackets, such as (011)";
        let rows = split(text, expected, |c| match c {
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

fn split(
    text: &str,
    expected: &'static str,
    cell: impl Fn(char) -> Option<Cell>,
) -> Result<Vec<[Cell; 3]>, SceneError> {
    let mut rows = Vec::new();
    for (i, part) in text.split('-').enumerate() {
        let part = part.trim();
        let wrong = |expected| SceneError::Notation { row: i + 1, text: shortened(part), expected };
        if i as u32 >= MAX_ROWS {
            return Err(wrong("at most 200 rows"));
        }
        let inner = part.strip_prefix('(').and_then(|p| p.strip_suffix(')')).ok_or_else(|| wrong(expected))?;
        let cells: Vec<Cell> =
            inner.chars().take(4).map(&cell).collect::<Option<_>>().ok_or_else(|| wrong(expected))?;
        rows.push(cells.try_into().map_err(|_| wrong(expected))?);
    }
    Ok(rows)
}

/// The start of a text that may be of any length.
fn shortened(text: &str) -> String {
    const MOST: usize = 20;
    if text.chars().count() <= MOST { text.to_owned() } else { text.chars().take(MOST).chain("...".chars()).collect() }
}
