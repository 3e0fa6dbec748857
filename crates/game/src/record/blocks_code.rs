//! Blocks as bytes: columns of numbers, against what a tower of such blocks has.
//!
//! A tower in the middle of a game is one whose blocks moved a little: what is left of its numbers
//! takes few bits where they are rounded. Every bit comes back in any case.

use teeter_scene::{Block, MAX_BLOCKS};

use crate::record::bytes::{Reader, Writer};
use crate::record::error::RecordError;
use crate::record::nominal_cell::NominalCell;
use crate::record::number_code::{
    Expected, differences, median, read_alike, read_numbers, sums, write_alike, write_numbers,
};
use crate::record::rice_code::{read_column, write_column};

/// Flags of a block.
const ORIENTED: i64 = 1;
const FIXED: i64 = 2;
const FRICTION: i64 = 4;
const MOVING: i64 = 8;

/// Writes blocks. Sizes and masses are expected to be those of a like tower where there is one, of
/// as many blocks.
pub fn write(writer: &mut Writer, blocks: &[Block], like: Option<&[Block]>) {
    writer.unsigned(blocks.len() as u64);
    let ids = (0..).zip(blocks).map(|(index, block)| i64::from(block.id) - index);
    write_column(writer, &ids.collect::<Vec<i64>>());
    let flags: Vec<i64> = blocks.iter().map(flags_of).collect();
    write_column(writer, &differences(&flags));
    let column = |of: &dyn Fn(&Block) -> f64| blocks.iter().map(of).collect::<Vec<f64>>();
    for k in 0..4 {
        let numbers = column(&|block| bulk(block, k));
        match like {
            Some(like) => write_numbers(writer, &numbers, alone(&bulks(like, k))),
            None => write_alike(writer, &numbers),
        }
    }
    let sizes = [0, 1, 2].map(|axis| column(&|block| block.size[axis]));

    let size = sizes.each_ref().map(|sizes| median(sizes));
    let cells: Vec<NominalCell> = blocks.iter().map(|block| NominalCell::of(block, size)).collect();
    NominalCell::columns(&cells).iter().for_each(|column| write_column(writer, column));
    let frame = TowerFrame { cells: &cells, size, heights: &sizes[2], upward: NominalCell::upward(&cells) };
    for axis in 0..3 {
        let expected = frame.positions(axis);
        write_numbers(writer, &column(&|block| block.pos[axis]), frame.expected(&expected, axis));
    }
    write_rotations(writer, blocks, &cells);

    let frictions: Vec<f64> = blocks.iter().filter_map(|block| block.friction).collect();
    write_alike(writer, &frictions);
    for k in 0..6 {
        let moving = blocks.iter().filter(|block| flags_of(block) & MOVING != 0);
        let speeds: Vec<f64> = moving.map(|block| if k < 3 { block.velocity[k] } else { block.spin[k - 3] }).collect();
        write_numbers(writer, &speeds, alone(&vec![0.0; speeds.len()]));
    }
}

/// Reads blocks. They may be such as no scene can have.
pub fn read(reader: &mut Reader, like: Option<&[Block]>) -> Result<Vec<Block>, RecordError> {
    let count = usize::try_from(reader.unsigned()?).ok().filter(|count| *count <= MAX_BLOCKS);
    let count = count.filter(|count| like.is_none_or(|like| like.len() == *count)).ok_or(reader.damaged())?;
    let ids = read_column(reader, count)?;
    let flags = sums(&read_column(reader, count)?);
    let mut bulk = |k: usize| match like {
        Some(like) => read_numbers(reader, alone(&bulks(like, k))),
        None => read_alike(reader, count),
    };
    let (sizes, masses) = ([bulk(0)?, bulk(1)?, bulk(2)?], bulk(3)?);

    let size = sizes.each_ref().map(|sizes| median(sizes));
    let cells = NominalCell::from_columns([read_column(reader, count)?, read_column(reader, count)?]);
    let frame = TowerFrame { cells: &cells, size, heights: &sizes[2], upward: NominalCell::upward(&cells) };
    let mut positions: [Vec<f64>; 3] = Default::default();
    for (axis, positions) in positions.iter_mut().enumerate() {
        let expected = frame.positions(axis);
        *positions = read_numbers(reader, frame.expected(&expected, axis))?;
    }
    let mut blocks = Vec::new();
    for index in 0..count {
        let id = ids[index].checked_add(index as i64).and_then(|id| u32::try_from(id).ok()).ok_or(reader.damaged())?;
        let [size, pos] = [&sizes, &positions].map(|columns| columns.each_ref().map(|column| column[index]));
        let fixed = flags[index] & FIXED != 0;
        blocks.push(Block { fixed, ..Block::new(id, size, masses[index], pos) });
    }
    read_rotations(reader, &mut blocks, &flags, &cells)?;
    read_others(reader, &mut blocks, &flags)?;
    Ok(blocks)
}

/// Reads friction and speeds of the blocks that have them.
fn read_others(reader: &mut Reader, blocks: &mut [Block], flags: &[i64]) -> Result<(), RecordError> {
    let those = |flag: i64| (0..flags.len()).filter(|index| flags[*index] & flag != 0).collect::<Vec<usize>>();
    let (rough, moving) = (those(FRICTION), those(MOVING));
    for (index, friction) in rough.iter().zip(read_alike(reader, rough.len())?) {
        blocks[*index].friction = Some(friction);
    }
    for k in 0..6 {
        let speeds = read_numbers(reader, alone(&vec![0.0; moving.len()]))?;
        for (index, speed) in moving.iter().zip(speeds) {
            let block = &mut blocks[*index];
            if k < 3 { block.velocity[k] = speed } else { block.spin[k - 3] = speed }
        }
    }
    Ok(())
}

/// Tower that positions are expected from.
struct TowerFrame<'a> {
    cells: &'a [NominalCell],
    /// Size of a typical block, m.
    size: [f64; 3],
    /// Height of each block, m.
    heights: &'a [f64],
    /// Indices of the blocks from the bottom to the top.
    upward: Vec<usize>,
}

impl TowerFrame<'_> {
    fn positions(&self, axis: usize) -> Vec<f64> {
        let cells = self.cells.iter().zip(self.heights);
        cells.map(|(cell, height)| cell.position(self.size, *height, axis)).collect()
    }

    /// Deviations of heights sum up from row to row.
    fn expected<'e>(&'e self, numbers: &'e [f64], axis: usize) -> Expected<'e> {
        Expected { numbers, order: (axis == 2).then_some(&self.upward) }
    }
}

/// Size along an axis, m, or mass, kg.
fn bulk(block: &Block, k: usize) -> f64 {
    block.size.get(k).copied().unwrap_or(block.mass)
}

fn bulks(blocks: &[Block], k: usize) -> Vec<f64> {
    blocks.iter().map(|block| bulk(block, k)).collect()
}

fn flags_of(block: &Block) -> i64 {
    let is_zero = |x: &f64| x.to_bits() == 0;
    let is_moving = !block.velocity.iter().chain(&block.spin).all(is_zero);
    let flag = |is_set: bool, flag: i64| if is_set { flag } else { 0 };
    flag(block.orientation.is_some(), ORIENTED)
        | flag(block.fixed, FIXED)
        | flag(block.friction.is_some(), FRICTION)
        | flag(is_moving, MOVING)
}

fn alone(numbers: &[f64]) -> Expected<'_> {
    Expected { numbers, order: None }
}

/// Writes the rotations about the vertical of the upright blocks, and the orientations of the
/// others.
fn write_rotations(writer: &mut Writer, blocks: &[Block], cells: &[NominalCell]) {
    let yaws = blocks.iter().zip(cells).filter(|(block, _)| block.orientation.is_none());
    let (yaws, expected): (Vec<f64>, Vec<f64>) = yaws.map(|(block, cell)| (block.yaw, cell.yaw())).unzip();
    write_numbers(writer, &yaws, alone(&expected));
    let oriented = blocks.iter().zip(cells).filter_map(|(block, cell)| Some((block.orientation?, *cell)));
    let (orientations, cells): (Vec<[f64; 4]>, Vec<NominalCell>) = oriented.unzip();
    for k in 0..4 {
        let parts: Vec<f64> = orientations.iter().map(|orientation| orientation[k]).collect();
        let expected = orientations.iter().zip(&cells).map(|(orientation, cell)| component(orientation, *cell, k));
        write_numbers(writer, &parts, alone(&expected.collect::<Vec<f64>>()));
    }
}

fn read_rotations(
    reader: &mut Reader,
    blocks: &mut [Block],
    flags: &[i64],
    cells: &[NominalCell],
) -> Result<(), RecordError> {
    let (oriented, upright): (Vec<usize>, Vec<usize>) =
        (0..blocks.len()).partition(|index| flags[*index] & ORIENTED != 0);
    let expected: Vec<f64> = upright.iter().map(|index| cells[*index].yaw()).collect();
    for (index, yaw) in upright.iter().zip(read_numbers(reader, alone(&expected))?) {
        blocks[*index].yaw = yaw;
    }
    let mut orientations = vec![[0.0; 4]; oriented.len()];
    for k in 0..4 {
        let expected = orientations.iter().zip(&oriented).map(|(orientation, i)| component(orientation, cells[*i], k));
        let parts = read_numbers(reader, alone(&expected.collect::<Vec<f64>>()))?;
        orientations.iter_mut().zip(parts).for_each(|(orientation, part)| orientation[k] = part);
    }
    for (index, orientation) in oriented.iter().zip(orientations) {
        blocks[*index].orientation = Some(orientation);
    }
    Ok(())
}

/// Component `k` that is expected of an orientation whose components before it are known: the last
/// one follows from a length of 1.
fn component(orientation: &[f64; 4], cell: NominalCell, k: usize) -> f64 {
    let nominal = cell.orientation()[k];
    let [x, y, z, _] = orientation;
    let square = 1.0 - x * x - y * y - z * z;
    if k == 3 && nominal != 0.0 && square > 0.0 { square.sqrt().copysign(nominal) } else { nominal }
}

#[cfg(test)]
mod tests {
    use glam::DQuat;
    use proptest::prelude::*;
    use teeter_scene::{NAMED, Random, TowerOptions, tower};

    use super::*;

    fn round_trip(blocks: &[Block]) -> usize {
        let mut writer = Writer::default();
        write(&mut writer, blocks, None);
        let mut reader = Reader::new(&writer.0, "its scene");
        let read = read(&mut reader, None).unwrap();
        reader.end().unwrap();
        assert_eq!(read, blocks);
        writer.0.len()
    }

    /// A tower whose blocks moved a little, in numbers rounded as the page rounds them.
    fn played(rows: u32) -> Vec<Block> {
        let mut blocks = tower(&TowerOptions { rows, ..TowerOptions::default() }).unwrap().blocks;
        let mut random = Random::new(4);
        let mut error = |size: f64| size * random.clipped_normal(2.0);
        // No zero is negative, as on the page.
        let rounded = |x: f64, parts: f64| (x * parts).round() / parts + 0.0;
        for (index, block) in blocks.iter_mut().enumerate() {
            let [x, y, mut z] = block.pos;
            // Some are on top.
            z += if index % 9 == 4 { 0.27 } else { 0.0 };
            block.pos = [rounded(x + error(3e-4), 1e5), rounded(y + error(3e-4), 1e5), rounded(z + error(1e-4), 1e6)];
            block.size = block.size.map(|edge| rounded(edge, 1e6));
            block.mass = rounded(block.mass, 1e5);
            let [_, _, z, w] = block.rotation();
            let turned = DQuat::from_xyzw(error(1e-3), error(1e-3), z + error(1e-3), w).normalize();
            (block.yaw, block.orientation) = (0.0, Some(turned.to_array().map(|x| rounded(x, 1e5))));
        }
        blocks
    }

    #[test]
    fn the_blocks_of_all_named_scenes_come_back_with_their_bits() {
        for named in NAMED {
            round_trip(&named.scene().blocks);
        }
    }

    #[test]
    fn a_block_of_a_tower_that_was_played_on_takes_at_most_twelve_bytes() {
        for rows in [18, 40] {
            let bytes = round_trip(&played(rows)) as f64 / f64::from(3 * rows);
            assert!(bytes <= 12.0, "{bytes} bytes a block of {rows} rows");
        }
    }

    #[test]
    fn a_block_takes_two_bytes_less_where_the_tower_it_was_is_known() {
        let (start, blocks) =
            (tower(&TowerOptions { rows: 18, ..TowerOptions::default() }).unwrap().blocks, played(18));
        let mut writer = Writer::default();
        write(&mut writer, &blocks, Some(&start));
        assert_eq!(read(&mut Reader::new(&writer.0, "its scene"), Some(&start)).as_ref(), Ok(&blocks));
        assert!(writer.0.len() + 2 * blocks.len() <= round_trip(&blocks), "{} bytes", writer.0.len());
        assert!(read(&mut Reader::new(&writer.0, "its scene"), Some(&start[1..])).is_err());
    }

    #[test]
    fn numbers_that_are_not_rounded_and_all_fields_come_back() {
        let mut blocks = played(4);
        blocks[3].friction = Some(0.1 + 0.2);
        blocks[4] = Block { fixed: true, yaw: 0.3, orientation: None, ..blocks[4].clone() };
        blocks[5].velocity = [1e-17, -0.0, 3.0];
        blocks[6].spin[2] = -1.0 / 3.0;
        blocks[7].id = u32::MAX;
        blocks[8].pos = [f64::MAX, -1e9, 1e-300];
        blocks[9].size = [0.0; 3];
        blocks[10].orientation = Some([0.0; 4]);
        round_trip(&blocks);
        round_trip(&[]);
    }

    proptest! {
        #[test]
        fn bytes_that_are_no_blocks_never_panic(at in 0usize..600, byte in any::<u8>(), cut in 0usize..600) {
            let mut writer = Writer::default();
            write(&mut writer, &played(8), None);
            let len = writer.0.len();
            writer.0[at % len] = byte;
            let _ = read(&mut Reader::new(&writer.0, "its scene"), None);
            let _ = read(&mut Reader::new(&writer.0[..cut % len], "its scene"), None);
        }
    }
}
