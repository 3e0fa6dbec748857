//! Data sheet of a real tower, measured with a kitchen scale and a spring balance.
//! `docs/validation.md` explains how to fill it in.

use std::f64::consts::FRAC_PI_2;
use std::str::FromStr;

use teeter_scene::{Block, Scene, SceneError, TowerOptions, tower};

/// Contact stiffness of a real tower, N/m.
pub(super) const STIFFNESS: f64 = 3e6;
/// Error of a balance where the sheet names none, N.
const BALANCE_ERROR: f64 = 0.02;
/// Clearance between the sides of blocks that are wider than a third of their length, m.
const CLEARANCE: f64 = 1e-4;

/// Real tower.
#[derive(Debug)]
pub struct DataSheet {
    /// Tower with the measured sizes and masses.
    pub scene: Scene,
    /// Measured breakaway force of each block, N: none where it was not pulled, infinite where it
    /// did not move.
    pub pulls: Vec<Option<f64>>,
    /// Error of the balance, N.
    pub error: f64,
}

/// Error of a data sheet.
#[derive(Debug, thiserror::Error)]
pub enum DataSheetError {
    /// Cell that is not a number of its range.
    #[error("line {line}: `{text}` is no number from {low} to {high}")]
    Number {
        /// Line, from 1.
        line: usize,
        /// Text of the cell.
        text: String,
        /// Minimum.
        low: f64,
        /// Maximum.
        high: f64,
    },
    /// Line before the blocks that begins with no known name.
    #[error(
        "line {line}: `{name}` is not known, expected length_mm, width_mm, friction, incline_deg, \
         balance_error_N or row"
    )]
    UnknownName {
        /// Line, from 1.
        line: usize,
        /// First cell.
        name: String,
    },
    /// Line that is missing.
    #[error("there is no {0}")]
    Missing(&'static str),
    /// Two lines for a block.
    #[error("row {row}, column {column} is there twice")]
    DuplicateBlock {
        /// Row, from 1.
        row: u32,
        /// Column, from 1.
        column: u32,
    },
    /// Row without a block below one with blocks.
    #[error("there is no block in row {0}")]
    EmptyRow(u32),
    /// Sheet without blocks.
    #[error("there are no blocks")]
    NoBlocks,
    /// Tower that is not a valid scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// Line of a block.
struct Line {
    /// Row, from 1.
    row: u32,
    /// Column, from 1.
    column: u32,
    /// Height, m.
    height: f64,
    /// Mass, kg.
    mass: f64,
    /// Breakaway force, N.
    pull: Option<f64>,
}

/// Values of the lines of a sheet.
struct Lines {
    length: Option<f64>,
    width: Option<f64>,
    friction: Option<f64>,
    error: f64,
    blocks: Option<Vec<Line>>,
}

/// Cells of a line.
struct Cells<'a> {
    line: usize,
    cells: Vec<&'a str>,
}

impl Cells<'_> {
    fn text(&self, index: usize) -> &str {
        self.cells.get(index).copied().unwrap_or_default()
    }

    fn number(&self, index: usize, low: f64, high: f64) -> Result<f64, DataSheetError> {
        let text = self.text(index);
        let number = text.parse::<f64>().ok().filter(|value| (low..=high).contains(value));
        number.ok_or_else(|| DataSheetError::Number { line: self.line, text: text.to_owned(), low, high })
    }

    fn block(&self) -> Result<Line, DataSheetError> {
        Ok(Line {
            row: self.number(0, 1.0, 200.0)? as u32,
            column: self.number(1, 1.0, 3.0)? as u32,
            height: 1e-3 * self.number(2, 1.0, 1000.0)?,
            mass: 1e-3 * self.number(3, 0.1, 10_000.0)?,
            pull: match self.text(4) {
                "" => None,
                "-" => Some(f64::INFINITY),
                _ => Some(self.number(4, 0.0, 100.0)?),
            },
        })
    }
}

impl Lines {
    /// Parses lines `name,value`, then a line of headings that begins with `row`, then a line a
    /// block.
    fn parse(text: &str) -> Result<Self, DataSheetError> {
        let mut lines = Self { length: None, width: None, friction: None, error: BALANCE_ERROR, blocks: None };
        for (number, line) in text.lines().enumerate() {
            let line = line.split('#').next().unwrap_or_default().trim();
            if !line.is_empty() {
                lines.add(&Cells { line: number + 1, cells: line.split(',').map(str::trim).collect() })?;
            }
        }
        Ok(lines)
    }

    fn add(&mut self, cells: &Cells) -> Result<(), DataSheetError> {
        if let Some(blocks) = &mut self.blocks {
            blocks.push(cells.block()?);
            return Ok(());
        }
        match cells.text(0) {
            "length_mm" => self.length = Some(1e-3 * cells.number(1, 5.0, 1000.0)?),
            "width_mm" => self.width = Some(1e-3 * cells.number(1, 5.0, 1000.0)?),
            "friction" => self.friction = Some(cells.number(1, 0.0, 2.0)?),
            "incline_deg" => self.friction = Some(libm::tan(cells.number(1, 0.0, 60.0)?.to_radians())),
            "balance_error_N" => self.error = cells.number(1, 0.0, 5.0)?,
            "row" => self.blocks = Some(Vec::new()),
            name => return Err(DataSheetError::UnknownName { line: cells.line, name: name.to_owned() }),
        }
        Ok(())
    }
}

/// Checks that each block has one line and each row a block, and returns the number of rows. The
/// blocks are in order.
fn count_rows(blocks: &[Line]) -> Result<u32, DataSheetError> {
    if let Some(pair) = blocks.windows(2).find(|pair| (pair[0].row, pair[0].column) == (pair[1].row, pair[1].column)) {
        return Err(DataSheetError::DuplicateBlock { row: pair[0].row, column: pair[0].column });
    }
    let rows = blocks.last().ok_or(DataSheetError::NoBlocks)?.row;
    match (1..=rows).find(|row| !blocks.iter().any(|block| block.row == *row)) {
        Some(row) => Err(DataSheetError::EmptyRow(row)),
        None => Ok(rows),
    }
}

/// Distance between the centres of a row of blocks of `length` and `width` (m): three side by side
/// are as wide as one is long, or almost touch where they are wider.
pub(super) fn row_pitch(length: f64, width: f64) -> f64 {
    ((length - width) / 2.0).max(width + CLEARANCE)
}

/// Stacks the blocks into a tower of `length` and `width` (m).
fn stack(blocks: &[Line], rows: u32, (length, width): (f64, f64)) -> Vec<Block> {
    let pitch = row_pitch(length, width);
    let (mut base, mut stacked) = (0.0, Vec::new());
    for row in 1..=rows {
        let in_row = || blocks.iter().filter(|block| block.row == row);
        for block in in_row() {
            let side = (f64::from(block.column) - 2.0) * pitch;
            let z = base + 0.5 * block.height;
            let (pos, yaw) = if row % 2 == 1 { ([0.0, side, z], 0.0) } else { ([side, 0.0, z], FRAC_PI_2) };
            let (id, size) = (10 * row + block.column, [length, width, block.height]);
            stacked.push(Block { yaw, ..Block::new(id, size, block.mass, pos) });
        }
        base += in_row().map(|block| block.height).fold(0.0, f64::max);
    }
    stacked
}

impl FromStr for DataSheet {
    type Err = DataSheetError;

    fn from_str(text: &str) -> Result<Self, DataSheetError> {
        let lines = Lines::parse(text)?;
        let missing = DataSheetError::Missing;
        let length = lines.length.ok_or(missing("`length_mm`"))?;
        let width = lines.width.ok_or(missing("`width_mm`"))?;
        let friction = lines.friction.ok_or(missing("`friction` or `incline_deg`"))?;
        let mut blocks = lines.blocks.ok_or(missing("`row`"))?;
        blocks.sort_by_key(|block| (block.row, block.column));
        let rows = count_rows(&blocks)?;
        let scene = Scene {
            name: "real tower".into(),
            stiffness: STIFFNESS,
            blocks: stack(&blocks, rows, (length, width)),
            ..tower(&TowerOptions { rows: 1, friction, ..TowerOptions::default() })?
        };
        scene.validate()?;
        Ok(Self { scene, pulls: blocks.iter().map(|block| block.pull).collect(), error: lines.error })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "length_mm,75\nwidth_mm,24.9\nincline_deg,20  # mean of \
        ten\nrow,column,height_mm,mass_g,pull_N\n1,2,15.0,14,\n2,1,15.0,14,0.05\n2,3,15.1,14,-\n";

    #[test]
    fn a_sheet_becomes_a_tower() {
        let sheet: DataSheet = GOOD.parse().unwrap();
        assert_eq!(sheet.scene.blocks.len(), 3);
        assert_eq!(sheet.pulls, [None, Some(0.05), Some(f64::INFINITY)]);
        assert!((sheet.scene.friction - 0.36397).abs() < 1e-5);
        assert_eq!(sheet.scene.blocks[2].id, 23);
        assert!((sheet.scene.blocks[2].pos[2] - (0.015 + 0.00755)).abs() < 1e-12);
    }

    #[test]
    fn errors_name_the_line_and_the_cell() {
        let error = |from: &str, to: &str| GOOD.replace(from, to).parse::<DataSheet>().unwrap_err().to_string();
        assert_eq!(error("75", "wide"), "line 1: `wide` is no number from 5 to 1000");
        assert_eq!(error("width_mm,24.9\n", ""), "there is no `width_mm`");
        assert_eq!(error("2,3,", "2,1,"), "row 2, column 1 is there twice");
        assert_eq!(error("1,2,15.0", "3,2,15.0"), "there is no block in row 1");
        assert!(error("width_mm", "wdth_mm").starts_with("line 2: `wdth_mm` is not known"));
    }
}
