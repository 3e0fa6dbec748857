//! Map of a tower: rows, cells, and the free slots on top.
//!
//! Rows are counted from 0 at the bottom. Cells are counted from 0 to 2 along the row's width,
//! towards +y where the blocks lie along x and towards +x where they lie along y, as the tower
//! builder places them.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};
use teeter_physics::BodyId;

use crate::blocks::Blocks;
use crate::orientation::rotation_about_z;

/// Space between the blocks of a row, m.
const GAP: f64 = 0.0003;
/// Space that a slot leaves to a neighbour that is there already, m: the hand needs it to lower a
/// block.
const PLAY: f64 = 0.0006;
/// Smallest play on both sides together with which a slot between two neighbours can be filled, m.
const MIN_PLAY: f64 = 0.00015;
/// Space above what lies beside a slot, m.
const CLEARANCE: f64 = 0.006;
/// Part of a block's height within which blocks lie in one row.
const ROW_HEIGHT: f64 = 0.5;
/// Vertical part of a block's own vertical axis from which it lies flat.
const FLAT: f64 = 0.98;
/// Cells of a row.
const CELLS: usize = 3;

/// Cell of a row.
///
/// ```
/// use teeter_game::CellId;
///
/// let cell: CellId = serde_json::from_str(r#"{"row": 17, "cell": 2}"#)?;
/// assert_eq!(cell, CellId { row: 17, cell: 2 });
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CellId {
    /// Row, from 0 at the bottom.
    pub row: u32,
    /// Cell, 0 to 2.
    pub cell: u32,
}

/// Free cell on top of the tower.
///
/// ```
/// use teeter_game::Game;
/// use teeter_physics::{BodyId, Params, World};
///
/// // on a full tower of 18 rows a new row begins
/// let scene = teeter_scene::named("tower").unwrap();
/// let game = Game::new(World::new(&scene, Params::default())?);
/// let slots = game.slots(BodyId(0));
/// assert_eq!(slots.len(), 3);
/// assert!(slots.iter().all(|slot| slot.id().row == 18 && slot.position.z > 0.32));
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Slot {
    /// Row, from 0 at the bottom.
    pub row: u32,
    /// Cell, 0 to 2.
    pub cell: u32,
    /// Centre of a block that lies there, m.
    pub position: DVec3,
    /// Orientation of a block that lies there.
    pub orientation: DQuat,
    /// Height above the slot at which a block passes over its neighbours, m.
    pub clearance: f64,
}

impl Slot {
    /// Row and cell.
    pub fn id(&self) -> CellId {
        CellId { row: self.row, cell: self.cell }
    }
}

/// Block that lies flat.
#[derive(Debug, Clone, Copy)]
struct FlatBlock {
    body: BodyId,
    position: DVec3,
    size: DVec3,
    /// Long axis, horizontal unit vector; its sign has no meaning.
    along: DVec3,
    /// Heights of its faces, m.
    top: f64,
    bottom: f64,
}

/// Blocks that lie flat, and the rows and cells that they are in.
///
/// ```
/// use teeter_game::{Blocks, CellId, TowerMap};
/// use teeter_physics::{BodyId, Params, World};
///
/// let scene = teeter_scene::named("tower").unwrap();
/// let blocks = Blocks::of(&World::new(&scene, Params::default())?);
/// let map = TowerMap::new(&blocks, None);
/// assert_eq!(map.cell_of(BodyId(53)), Some(CellId { row: 17, cell: 2 }));
/// assert_eq!(map.slots(blocks.size(BodyId(53))).len(), 3);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone)]
pub struct TowerMap {
    flat: Vec<FlatBlock>,
}

impl TowerMap {
    /// Map of all blocks but one: that in the hand.
    pub fn new(blocks: &Blocks, without: Option<BodyId>) -> Self {
        let flat = |body: BodyId| {
            let (position, orientation) = (blocks.position(body), blocks.orientation(body));
            let lies = (orientation * DVec3::Z).z.abs() >= FLAT && position.is_finite();
            lies.then(|| {
                let half = 0.5 * blocks.edges(body).z;
                FlatBlock {
                    body,
                    position,
                    size: blocks.size(body),
                    along: (orientation * DVec3::X).with_z(0.0).normalize_or_zero(),
                    top: position.z + half,
                    bottom: position.z - half,
                }
            })
        };
        Self { flat: blocks.bodies().filter(|body| Some(*body) != without).filter_map(flat).collect() }
    }

    /// Returns the block in a cell.
    pub fn block(&self, id: CellId) -> Option<BodyId> {
        self.cells().into_iter().find(|(_, cell)| *cell == id).map(|(body, _)| body)
    }

    /// Returns the cell that a block is in; none for a block beside the tower.
    pub fn cell_of(&self, body: BodyId) -> Option<CellId> {
        self.cells().into_iter().find(|(other, _)| *other == body).map(|(_, cell)| cell)
    }

    /// Blocks that are in a cell, with their cells, from the bottom row to the top one.
    pub fn cells(&self) -> Vec<(BodyId, CellId)> {
        let rows = self.rows();
        let mut cells = Vec::new();
        for (r, row) in rows.iter().enumerate() {
            let row = within_tower(&rows, r, row);
            let Some(first) = row.first() else { continue };
            let across = canonical(DVec3::Z.cross(mean_axis(&row)));
            let pitch = first.size.y + GAP;
            // A row that crosses this one says where its middle is, also where this row has gaps.
            let neighbours =
                [r.checked_sub(1), Some(r + 1)].into_iter().flatten().filter_map(|n| Some((n, rows.get(n)?)));
            let crossing = neighbours
                .map(|(n, row)| within_tower(&rows, n, row))
                .find(|row| !row.is_empty() && row.iter().all(|b| b.along.dot(across).abs() > 0.9));
            let coordinate = |b: &FlatBlock| b.position.dot(across);
            let middle = mean(crossing.unwrap_or_else(|| row.clone()).iter().map(coordinate));
            let mut taken: Vec<(BodyId, CellId, f64)> = Vec::new();
            for block in &row {
                let offset = (coordinate(block) - middle) / pitch;
                let cell = libm::round(offset);
                if cell.abs() > 1.0 {
                    continue;
                }
                let id = CellId { row: r as u32, cell: (cell + 1.0) as u32 };
                let error = (offset - cell).abs();
                match taken.iter_mut().find(|(_, other, _)| *other == id) {
                    Some(other) if other.2 > error => *other = (block.body, id, error),
                    Some(_) => {}
                    None => taken.push((block.body, id, error)),
                }
            }
            taken.sort_by_key(|(_, id, _)| id.cell);
            cells.extend(taken.into_iter().map(|(body, id, _)| (body, id)));
        }
        cells
    }

    /// Free slots on top for a block of edge lengths `size` (m): what is left of an unfinished row,
    /// or a new row across a full one. None while nothing stands.
    pub fn slots(&self, size: DVec3) -> Vec<Slot> {
        let Some(highest) = self.flat.iter().map(|b| b.position.z).reduce(f64::max) else { return Vec::new() };
        let (row, lower): (Vec<FlatBlock>, Vec<FlatBlock>) =
            self.flat.iter().partition(|b| highest - b.position.z < ROW_HEIGHT * size.z);
        let below = rows_by_height(lower.iter().map(|b| (b.position.z, b.size.z))).len() as u32;
        let axis = canonical(mean_axis(&row));
        let across = canonical(DVec3::Z.cross(axis));
        if row.len() >= CELLS {
            let centre =
                DVec3::new(mean(row.iter().map(|b| b.position.x)), mean(row.iter().map(|b| b.position.y)), 0.0);
            let top = row.iter().map(|b| b.top).fold(f64::NEG_INFINITY, f64::max);
            return RowPlan { row: below + 1, centre, along: across, side: axis, top }.slots(size).to_vec();
        }
        unfinished_row(&row, &lower, below, axis, size)
    }

    /// Blocks by row, bottom first.
    fn rows(&self) -> Vec<Vec<FlatBlock>> {
        let rows = rows_by_height(self.flat.iter().map(|b| (b.position.z, b.size.z)));
        rows.into_iter().map(|row| row.into_iter().map(|i| self.flat[i]).collect()).collect()
    }
}

/// Free slots of the top row, of which one or two cells are taken. `row` is its number and `axis`
/// its long axis.
fn unfinished_row(top_row: &[FlatBlock], lower: &[FlatBlock], row: u32, axis: DVec3, size: DVec3) -> Vec<Slot> {
    let across = canonical(DVec3::Z.cross(axis));
    let pitch = size.y + GAP;
    let bottom = mean(top_row.iter().map(|b| b.bottom));
    let is_beneath = |b: &&FlatBlock| {
        let near = |other: &FlatBlock| (other.position - b.position).truncate().length() < size.x;
        (b.top - bottom).abs() < 0.25 * size.z && b.along.dot(across).abs() > 0.9 && top_row.iter().any(near)
    };
    let beneath: Vec<FlatBlock> = lower.iter().filter(is_beneath).copied().collect();
    let coordinate = |b: &FlatBlock| b.position.dot(across);
    // A row on the floor has no row beneath it to say where its middle is.
    let supports: &[FlatBlock] = if beneath.is_empty() { top_row } else { &beneath };
    let centre =
        axis * mean(top_row.iter().map(|b| b.position.dot(axis))) + across * mean(supports.iter().map(coordinate));
    let top = beneath.iter().map(|b| b.top).reduce(f64::max).unwrap_or(bottom);
    let plan = RowPlan { row, centre, along: axis, side: across, top };
    plan.slots(size).into_iter().filter_map(|slot| beside_neighbours(slot, top_row, across, size.y, pitch)).collect()
}

/// Moves a slot clear of its neighbours, which need not lie where the plan has them; none where a
/// block lies in it or none fits.
fn beside_neighbours(mut slot: Slot, row: &[FlatBlock], across: DVec3, width: f64, pitch: f64) -> Option<Slot> {
    let planned = slot.position.dot(across);
    let coordinates = || row.iter().map(|b| b.position.dot(across));
    if coordinates().any(|c| (c - planned).abs() < 0.6 * pitch) {
        return None;
    }
    let near = |c: &f64| (c - planned).abs() < 1.5 * pitch;
    let below = coordinates().filter(|c| *c < planned).filter(near).reduce(f64::max);
    let above = coordinates().filter(|c| *c > planned).filter(near).reduce(f64::min);
    let lowest = below.map_or(f64::NEG_INFINITY, |c| c + width + PLAY);
    let highest = above.map_or(f64::INFINITY, |c| c - width - PLAY);
    if highest - lowest + 2.0 * PLAY < MIN_PLAY {
        return None;
    }
    let best = if lowest > highest { 0.5 * (lowest + highest) } else { planned.max(lowest).min(highest) };
    slot.position += across * (best - planned);
    Some(slot)
}

/// Three cells side by side.
struct RowPlan {
    row: u32,
    /// Middle of the row; its height has no meaning.
    centre: DVec3,
    /// Long axis of its blocks, and the direction in which the cells follow each other.
    along: DVec3,
    side: DVec3,
    /// Height of what bears it, m.
    top: f64,
}

impl RowPlan {
    fn slots(&self, size: DVec3) -> [Slot; CELLS] {
        let orientation = rotation_about_z(libm::atan2(self.along.y, self.along.x));
        [0, 1, 2].map(|cell| Slot {
            row: self.row,
            cell,
            position: (self.centre + self.side * ((f64::from(cell) - 1.0) * (size.y + GAP)))
                .with_z(self.top + 0.5 * size.z),
            orientation,
            clearance: size.z + CLEARANCE,
        })
    }
}

/// Groups blocks by height, bottom first: a row reaches half a block's height up from its lowest
/// block. Items are the height of a block's centre and its thickness, m; the rows hold their
/// indices.
pub(crate) fn rows_by_height(items: impl Iterator<Item = (f64, f64)>) -> Vec<Vec<usize>> {
    let mut items: Vec<(usize, (f64, f64))> = items.enumerate().collect();
    items.sort_by(|(_, a), (_, b)| a.0.total_cmp(&b.0));
    let mut rows: Vec<Vec<usize>> = Vec::new();
    let mut limit = f64::NEG_INFINITY;
    for (index, (height, thickness)) in items {
        match rows.last_mut() {
            Some(row) if height <= limit => row.push(index),
            _ => {
                limit = height + ROW_HEIGHT * thickness;
                rows.push(vec![index]);
            }
        }
    }
    rows
}

/// Blocks of row `r` without those that lie beside the tower. The rows around it say where the
/// tower is; the bottom row does not, for the blocks on the floor are in it.
fn within_tower(rows: &[Vec<FlatBlock>], r: usize, row: &[FlatBlock]) -> Vec<FlatBlock> {
    let around: Vec<&FlatBlock> =
        rows.iter().enumerate().skip(1).filter(|(n, _)| n.abs_diff(r) <= 2).flat_map(|(_, row)| row).collect();
    if around.is_empty() {
        return row.to_vec();
    }
    let axis = around.iter().map(|b| b.position).sum::<DVec3>() / around.len() as f64;
    let near = |b: &&FlatBlock| (b.position - axis).truncate().length() < 0.55 * b.size.x;
    row.iter().filter(near).copied().collect()
}

/// The horizontal axis, of two opposite ones, that points to +x or +y.
fn canonical(axis: DVec3) -> DVec3 {
    if axis.x + axis.y < 0.0 { -axis } else { axis }
}

/// Mean direction of axes whose sign has no meaning.
fn mean_axis(row: &[FlatBlock]) -> DVec3 {
    let first = row.first().map_or(DVec3::X, |b| b.along);
    let sum: DVec3 = row.iter().map(|b| if b.along.dot(first) < 0.0 { -b.along } else { b.along }).sum();
    sum.normalize_or(DVec3::X)
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
    sum / count
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blocks::samples::{PITCH, SIZE, blocks, moved, push, tower};

    fn slots(blocks: &Blocks, held: Option<BodyId>) -> Vec<Slot> {
        TowerMap::new(blocks, held).slots(SIZE)
    }

    fn assert_close(a: f64, b: f64, bound: f64) {
        assert!((a - b).abs() < bound, "{a} and {b}");
    }

    #[test]
    fn a_full_row_takes_a_new_one_across_it() {
        for yaw in [0.0, 0.3, -1.2] {
            let slots = slots(&tower(&["xxx", "xxx", "xxx"], yaw), None);
            assert_eq!(slots.iter().map(|s| (s.row, s.cell)).collect::<Vec<_>>(), [(3, 0), (3, 1), (3, 2)]);
            let mut distances: Vec<f64> = slots.iter().map(|s| s.position.truncate().length()).collect();
            distances.sort_by(f64::total_cmp);
            for (distance, expected) in distances.iter().zip([0.0, PITCH, PITCH]) {
                assert_close(*distance, expected, 5e-7);
            }
            for slot in &slots {
                assert_close(slot.position.z, 3.5 * SIZE.z, 5e-7);
            }
            // The top row lies along x of the tower, so the new one lies along y.
            let turn = 2.0 * libm::atan2(slots[0].orientation.z, slots[0].orientation.w) - yaw;
            assert_close(libm::sin(turn).abs(), 1.0, 5e-7);
        }
    }

    #[test]
    fn an_unfinished_row_is_finished_first_wherever_its_blocks_are() {
        for (row, free) in [("x..", &[0, 1][..]), (".x.", &[-1, 1]), ("..x", &[-1, 0]), ("x.x", &[0]), ("xx.", &[1])] {
            let slots = slots(&tower(&["xxx", "xxx", row], 0.0), None);
            let columns: Vec<i32> = slots.iter().map(|s| (s.position.y / PITCH).round() as i32).collect();
            assert_eq!(columns, free, "{row}");
            for slot in &slots {
                assert_eq!((slot.row, slot.cell as i32 - 1), (2, (slot.position.y / PITCH).round() as i32));
                assert_close(slot.position.z, 2.5 * SIZE.z, 5e-7);
                assert!(slot.position.x.abs() < 1e-6);
            }
        }
    }

    #[test]
    fn a_slot_keeps_clear_of_a_neighbour_beside_its_cell_and_none_is_offered_where_no_block_fits() {
        // Bodies 6 and 7 are those of the third row.
        let shifted = |by: f64| slots(&moved(&tower(&["xxx", "xxx", "x.x"], 0.0), 6, DVec3::Y * by), None);
        assert!(shifted(0.002).is_empty());
        let [slot] = shifted(-0.002)[..] else { panic!("one slot is free") };
        let middle = slot.position.y;
        assert!(middle <= 0.0);
        assert!(middle - (-PITCH - 0.002) > SIZE.y);
        assert!(PITCH - middle > SIZE.y);
    }

    #[test]
    fn the_held_block_does_not_count_so_taking_the_last_of_a_row_leaves_its_row_to_be_built() {
        let slots = slots(&tower(&["xxx", "xxx", ".x."], 0.0), Some(BodyId(6)));
        assert_eq!(slots.len(), 3);
        for slot in slots {
            assert_close(slot.position.z, 2.5 * SIZE.z, 5e-7);
        }
    }

    #[test]
    fn a_gap_lower_down_is_no_slot_and_a_block_on_the_floor_is_no_row() {
        assert!(slots(&tower(&["xxx", "x.x", "xxx"], 0.0), None).iter().all(|s| s.position.z > 3.0 * SIZE.z));
        assert!(slots(&tower(&["..."], 0.0), None).is_empty());
        // With nothing but two blocks on the floor the third slot is beside them.
        let one = slots(&tower(&["xx."], 0.0), None);
        assert!(one.iter().all(|s| s.position.z > 0.0 && s.position.z < SIZE.z));
    }

    #[test]
    fn a_block_is_found_by_its_row_and_cell() {
        let full = tower(&["xxx"; 6], 0.0);
        for body in full.bodies() {
            let id = CellId { row: body.0 / 3, cell: body.0 % 3 };
            let map = TowerMap::new(&full, None);
            assert_eq!((map.block(id), map.cell_of(body)), (Some(body), Some(id)));
        }
        for rows in [["xxx", ".x.", "x.x", "xxx", ".xx", "x.."], ["x.x", "xxx", ".x.", "xxx", "xx.", "..x"]] {
            let tower = tower(&rows, 0.2);
            let expected = (0..).zip(rows).flat_map(|(row, text)| {
                (0..).zip(text.chars()).filter(|(_, c)| *c == 'x').map(move |(cell, _)| CellId { row, cell })
            });
            let found: Vec<CellId> = TowerMap::new(&tower, None).cells().into_iter().map(|(_, id)| id).collect();
            assert_eq!(found, expected.collect::<Vec<_>>());
        }
    }

    #[test]
    fn a_block_on_the_floor_beside_the_tower_is_in_no_cell() {
        let full = tower(&["xxx"; 4], 0.0);
        let mut poses = Vec::new();
        for body in full.bodies() {
            push(&mut poses, full.position(body), full.orientation(body));
        }
        push(&mut poses, DVec3::new(0.02, 0.09, 0.009), rotation_about_z(0.7));
        let map = TowerMap::new(&blocks(&poses), None);
        assert_eq!(map.cell_of(BodyId(12)), None);
        assert_eq!(map.cells().len(), 12);
    }
}
