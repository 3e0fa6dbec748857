//! Real blocks, and rows of towers built of them with the blocks that were loose.
//! `docs/validation.md` explains the two tables.

use serde::Deserialize;
use teeter_scene::{Block, BlockPreset, Scene, SceneError, TowerOptions, tower};

use super::data_sheet::{STIFFNESS, row_pitch};

/// Blocks of a row.
const IN_ROW: usize = 3;

/// Block of the table, in millimetres and grams.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct BlockLine {
    id: u32,
    length_mm: f64,
    width_mm: f64,
    height_mm: f64,
    #[serde(default)]
    mass_g: Option<f64>,
}

/// Row of the table, by ids of blocks.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct RowLine {
    first: u32,
    middle: u32,
    last: u32,
    label: usize,
}

/// Block as measured.
#[derive(Debug, Clone, PartialEq)]
pub struct RealBlock {
    /// Id in the table.
    pub id: u32,
    /// Length, width and height, m.
    pub size: [f64; 3],
    /// Mass, kg.
    pub mass: f64,
}

/// Blocks of a row that are loose: first, middle, last.
pub type Loose = [bool; IN_ROW];

/// Loose blocks by label: none, the first, the last, the middle, both sides.
const LABELS: [Loose; 5] =
    [[false, false, false], [true, false, false], [false, false, true], [false, true, false], [true, false, true]];

/// Row of a real tower.
#[derive(Debug, Clone, PartialEq)]
pub struct RealRow {
    /// Indices of the blocks as they lie.
    pub blocks: [usize; IN_ROW],
    /// Blocks that were loose.
    pub loose: Loose,
}

/// Order of the rows of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RowOrder {
    /// From the lowest row to the highest.
    BottomUp,
    /// From the highest row to the lowest.
    TopDown,
}

impl RowOrder {
    /// Both orders.
    pub const ALL: [Self; 2] = [Self::BottomUp, Self::TopDown];

    /// Name of the order.
    pub fn name(self) -> &'static str {
        match self {
            Self::BottomUp => "from the bottom up",
            Self::TopDown => "from the top down",
        }
    }
}

/// Blocks of a real set, and rows of towers that were built of them.
#[derive(Debug)]
pub struct RealRows {
    /// Blocks as measured.
    pub blocks: Vec<RealBlock>,
    /// Rows, a tower after the other.
    pub rows: Vec<RealRow>,
}

/// Error of the tables of a real set.
#[derive(Debug, thiserror::Error)]
pub enum RealRowsError {
    /// Table that is not of its form.
    #[error("the table of {table} cannot be read: {}", reason(source))]
    Table {
        /// Content of the table.
        table: &'static str,
        /// Cause.
        source: csv::Error,
    },
    /// Measurement out of its range.
    #[error("block {id}: {field} is {value}, expected {low} to {high}")]
    Range {
        /// Id of the block.
        id: u32,
        /// Column.
        field: &'static str,
        /// Its value.
        value: f64,
        /// Minimum.
        low: f64,
        /// Maximum.
        high: f64,
    },
    /// Two lines for a block.
    #[error("block {0} is there twice")]
    DuplicateBlock(u32),
    /// Row with a block that is not in the table of blocks.
    #[error("row {row}: there is no block {id}")]
    UnknownBlock {
        /// Row, from 1.
        row: usize,
        /// Id.
        id: u32,
    },
    /// Row with a label of no meaning.
    #[error("row {row}: label {label} is not known, expected 0 to 4")]
    Label {
        /// Row, from 1.
        row: usize,
        /// The label.
        label: usize,
    },
    /// Fewer blocks than two rows.
    #[error("there are {0} blocks, expected 6 or more: two rows of three")]
    FewBlocks(usize),
    /// Table without rows.
    #[error("there are no rows")]
    NoRows,
}

impl RealRows {
    /// Parses the table of blocks, `id,length_mm,width_mm,height_mm` and `mass_g` where they were
    /// weighed, and the table of rows, `first,middle,last,label`. Text after `#` at the start of a
    /// line is ignored.
    ///
    /// # Errors
    /// When a table has another form, or a row names a block or label that does not exist.
    pub fn parse(blocks: &str, rows: &str) -> Result<Self, RealRowsError> {
        let lines: Vec<BlockLine> = read(blocks).map_err(|source| RealRowsError::Table { table: "blocks", source })?;
        if lines.len() < 2 * IN_ROW {
            return Err(RealRowsError::FewBlocks(lines.len()));
        }
        let blocks: Vec<RealBlock> = lines.iter().map(real_block).collect::<Result<_, _>>()?;
        if let Some(i) = (1..blocks.len()).find(|&i| blocks[..i].iter().any(|other| other.id == blocks[i].id)) {
            return Err(RealRowsError::DuplicateBlock(blocks[i].id));
        }
        let lines: Vec<RowLine> = read(rows).map_err(|source| RealRowsError::Table { table: "rows", source })?;
        if lines.is_empty() {
            return Err(RealRowsError::NoRows);
        }
        let row = |(i, line): (usize, &RowLine)| {
            let find = |id| blocks.iter().position(|block| block.id == id);
            let index = |id| find(id).ok_or(RealRowsError::UnknownBlock { row: i + 1, id });
            let loose = LABELS.get(line.label).ok_or(RealRowsError::Label { row: i + 1, label: line.label })?;
            Ok(RealRow { blocks: [index(line.first)?, index(line.middle)?, index(line.last)?], loose: *loose })
        };
        let rows = lines.iter().enumerate().map(row).collect::<Result<_, _>>()?;
        Ok(Self { blocks, rows })
    }

    /// Number of labelled rows of a tower: all that the blocks suffice for but the top one, of
    /// which every block is loose.
    pub fn rows_of_tower(&self) -> usize {
        self.blocks.len() / IN_ROW - 1
    }

    /// Heights of the blocks, m.
    pub fn heights(&self) -> Vec<f64> {
        self.blocks.iter().map(|block| block.size[2]).collect()
    }

    /// Rows of each tower.
    pub fn towers(&self) -> impl Iterator<Item = &[RealRow]> {
        self.rows.chunks(self.rows_of_tower())
    }

    /// Builds a tower of some rows with blocks of `heights` (m), and above them the top row: the
    /// first three blocks that are in none of the rows. Blocks of the scene are in the order of the
    /// rows, three a row.
    ///
    /// # Errors
    /// When the engine cannot build such a tower.
    pub fn scene(&self, rows: &[RealRow], order: RowOrder, heights: &[f64]) -> Result<Scene, SceneError> {
        let used = |block: &usize| rows.iter().any(|row| row.blocks.contains(block));
        let top: Vec<usize> = (0..self.blocks.len()).filter(|block| !used(block)).take(IN_ROW).collect();
        let mut upwards: Vec<usize> = (0..rows.len()).collect();
        if order == RowOrder::TopDown {
            upwards.reverse();
        }
        let mut placed: Vec<Option<Block>> = vec![None; IN_ROW * rows.len()];
        let mut stack = Stack::new(&self.blocks, heights);
        for row in upwards {
            for (column, block) in stack.add(&rows[row].blocks).into_iter().enumerate() {
                placed[IN_ROW * row + column] = Some(block);
            }
        }
        let mut blocks: Vec<Block> = placed.into_iter().flatten().collect();
        blocks.extend(stack.add(&top));
        for (id, block) in (0..).zip(&mut blocks) {
            block.id = id;
        }
        let scene = Scene {
            name: "real tower".into(),
            stiffness: STIFFNESS,
            blocks,
            ..tower(&TowerOptions { rows: 1, ..TowerOptions::default() })?
        };
        scene.validate()?;
        Ok(scene)
    }
}

/// Tower that is being built.
struct Stack<'a> {
    blocks: &'a [RealBlock],
    /// Heights of the blocks, m.
    heights: &'a [f64],
    /// Distance between the centres of a row, m.
    pitch: f64,
    /// Height of the top so far, m.
    top: f64,
    rows: usize,
}

impl<'a> Stack<'a> {
    fn new(blocks: &'a [RealBlock], heights: &'a [f64]) -> Self {
        let largest = |k: usize| blocks.iter().map(|block| block.size[k]).fold(0.0, f64::max);
        Self { blocks, heights, pitch: row_pitch(largest(0), largest(1)), top: 0.0, rows: 0 }
    }

    /// Adds a row of blocks.
    fn add(&mut self, row: &[usize]) -> Vec<Block> {
        let base = self.top;
        let put = |(column, &block): (usize, &usize)| {
            let RealBlock { size, mass, .. } = self.blocks[block];
            let size = [size[0], size[1], self.heights[block]];
            let (side, z) = ((column as f64 - 1.0) * self.pitch, base + 0.5 * size[2]);
            let (pos, yaw) = if self.rows.is_multiple_of(2) {
                ([0.0, side, z], 0.0)
            } else {
                ([side, 0.0, z], std::f64::consts::FRAC_PI_2)
            };
            Block { yaw, ..Block::new(0, size, mass, pos) }
        };
        let placed = row.iter().enumerate().map(put).collect();
        self.top += row.iter().map(|&block| self.heights[block]).fold(0.0, f64::max);
        self.rows += 1;
        placed
    }
}

/// Reads a table with a line of headings.
fn read<T: for<'de> Deserialize<'de>>(text: &str) -> Result<Vec<T>, csv::Error> {
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).comment(Some(b'#')).from_reader(text.as_bytes());
    reader.deserialize().collect()
}

/// Reason of a table that cannot be read, with its line and column.
fn reason(error: &csv::Error) -> String {
    let csv::ErrorKind::Deserialize { pos, err } = error.kind() else { return error.to_string() };
    let line = pos.as_ref().map_or(String::new(), |pos| format!("line {}, ", pos.line()));
    let column = err.field().map_or(String::new(), |field| format!("column {}: ", field + 1));
    format!("{line}{column}{}", err.kind())
}

/// Checks a line of the table of blocks. Where there is no mass, the block has the density of the
/// official preset.
fn real_block(line: &BlockLine) -> Result<RealBlock, RealRowsError> {
    let range = |field, value: f64, low, high| {
        let is_inside = (low..=high).contains(&value);
        if is_inside { Ok(1e-3 * value) } else { Err(RealRowsError::Range { id: line.id, field, value, low, high }) }
    };
    let edge = |field, value| range(field, value, 1.0, 1000.0);
    let size =
        [edge("length_mm", line.length_mm)?, edge("width_mm", line.width_mm)?, edge("height_mm", line.height_mm)?];
    let official = BlockPreset::Official;
    let density = official.mass() / official.size().iter().product::<f64>();
    let mass = match line.mass_g {
        Some(mass) => range("mass_g", mass, 0.1, 10_000.0)?,
        None => density * size.iter().product::<f64>(),
    };
    Ok(RealBlock { id: line.id, size, mass })
}

#[cfg(test)]
mod tests {
    use super::*;

    const BLOCKS: &str = "id,length_mm,width_mm,height_mm\n# made up\n1,75,25,15\n2, 75,25,14.9\n3,75,25,15\n\
        4,75,25,14.8\n5,75,25,15\n6,75,25,14.8\n7,75,24,15\n8,75,25,15\n9,75,25,15\n";
    const ROWS: &str = "first,middle,last,label\n1,2,3,3\n4,5,6,4\n";

    fn error(blocks: &str, rows: &str) -> String {
        RealRows::parse(blocks, rows).unwrap_err().to_string()
    }

    #[test]
    fn two_tables_become_a_tower_in_either_order_with_the_rest_on_top() {
        let real = RealRows::parse(BLOCKS, ROWS).unwrap();
        assert_eq!(real.rows_of_tower(), 2);
        assert_eq!((real.rows[0].loose, real.rows[1].loose), ([false, true, false], [true, false, true]));
        let towers: Vec<&[RealRow]> = real.towers().collect();
        assert_eq!(towers.len(), 1);
        let build = |order| real.scene(towers[0], order, &real.heights()).unwrap();
        let (up, down) = (build(RowOrder::BottomUp), build(RowOrder::TopDown));
        let height = |scene: &Scene, block: usize| scene.blocks[block].pos[2];
        assert!((height(&up, 0) - 0.0075).abs() < 1e-12 && (height(&up, 4) - 0.0225).abs() < 1e-12);
        assert!((height(&down, 0) - 0.0225).abs() < 1e-12 && (height(&down, 4) - 0.0075).abs() < 1e-12);
        // blocks 7, 8 and 9
        assert!((0..3).all(|i| (height(&up, 6 + i) - 0.0375).abs() < 1e-12 && up.blocks.len() == 9));
        assert!((up.blocks[6].size[1] - 0.024).abs() < 1e-12);
        let official = BlockPreset::Official;
        assert!((up.blocks[0].mass - official.mass()).abs() < 1e-6 * official.mass(), "{}", up.blocks[0].mass);
    }

    #[test]
    fn a_mass_may_be_given() {
        let blocks = BLOCKS.replace("height_mm", "height_mm,mass_g").replace("15\n", "15,20\n");
        let blocks = blocks.replace("14.9\n", "14.9,19\n").replace("14.8\n", "14.8,18\n");
        let masses: Vec<f64> = RealRows::parse(&blocks, ROWS).unwrap().blocks.iter().map(|b| b.mass).collect();
        assert!(masses.iter().zip([0.02, 0.019, 0.02, 0.018]).all(|(mass, given)| (mass - given).abs() < 1e-12));
    }

    #[test]
    fn errors_name_the_table_the_row_and_the_block() {
        assert!(
            error(&BLOCKS.replace("height_mm", "hight_mm"), ROWS).starts_with("the table of blocks cannot be read")
        );
        assert!(error(&BLOCKS.replace("14.9", "tall"), ROWS).ends_with("line 4, column 4: invalid float literal"));
        assert_eq!(error(&BLOCKS.replace("14.9", "0.9"), ROWS), "block 2: height_mm is 0.9, expected 1 to 1000");
        assert_eq!(error(&BLOCKS.replace("2, 75", "1, 75"), ROWS), "block 1 is there twice");
        assert_eq!(error(BLOCKS, &ROWS.replace("4,5,6", "4,77,6")), "row 2: there is no block 77");
        assert_eq!(error(BLOCKS, &ROWS.replace("6,4", "6,5")), "row 2: label 5 is not known, expected 0 to 4");
        assert_eq!(error(BLOCKS, "first,middle,last,label\n"), "there are no rows");
        assert_eq!(
            error("id,length_mm,width_mm,height_mm\n1,75,25,15\n", ROWS),
            "there are 1 blocks, expected 6 or more: two rows of three"
        );
    }
}
