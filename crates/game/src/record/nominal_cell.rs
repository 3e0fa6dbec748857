//! Nominal cell of a block: where it would be in a full tower of blocks like it, as a guess at its
//! pose.

use std::f64::consts::FRAC_1_SQRT_2;

use teeter_scene::Block;

/// Number of orientations by quarter turns about the vertical, each as two quaternions.
const TURNS: i64 = 8;
/// Number of blocks in a row, and in the two rows after which orientations recur.
const CELLS: i64 = 3;
const PERIOD: usize = 6;

/// Cell of a full tower that a block is nearest to. Any block has one, also beside a tower.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NominalCell {
    /// Quarter turns about the vertical, 0 to 3, and 4 more for the opposite quaternion.
    turns: i64,
    /// Number of cells before this one, from the bottom.
    rank: i64,
}

impl NominalCell {
    /// The cell nearest to a block, where `size` is that of a typical block, m.
    pub fn of(block: &Block, size: [f64; 3]) -> Self {
        let rotation = block.rotation();
        let likeness = |turns: &i64| {
            let orientation = Self { turns: *turns, rank: 0 }.orientation();
            rotation.iter().zip(orientation).map(|(a, b)| a * b).sum::<f64>()
        };
        let turns = (0..TURNS).max_by(|a, b| likeness(a).total_cmp(&likeness(b))).unwrap_or_default();
        let across = if turns % 2 == 0 { block.pos[1] } else { block.pos[0] };
        let row = (block.pos[2] / size[2] - 0.5).round() as i64;
        let cell = (across / size[1]).round().clamp(-1.0, 1.0) as i64;
        Self { turns, rank: row.wrapping_mul(CELLS).wrapping_add(cell + 1) }
    }

    /// Position in this cell of a block of height `height`, along an axis, m.
    pub fn position(self, size: [f64; 3], height: f64, axis: usize) -> f64 {
        let (row, cell) = (self.rank.div_euclid(CELLS), self.rank.rem_euclid(CELLS) - 1);
        match axis {
            2 => row as f64 * size[2] + 0.5 * height,
            _ if (axis == 0) == (self.turns % 2 != 0) => cell as f64 * size[1],
            _ => 0.0,
        }
    }

    /// Orientation in this cell: x, y, z, w.
    pub fn orientation(self) -> [f64; 4] {
        const HALF: f64 = FRAC_1_SQRT_2;
        let [z, w] = [[0.0, 1.0], [HALF, HALF], [1.0, 0.0], [HALF, -HALF]][(self.turns % 4) as usize];
        if self.turns < 4 { [0.0, 0.0, z, w] } else { [0.0, 0.0, -z, -w] }
    }

    /// Rotation about the vertical in this cell, rad.
    pub fn yaw(self) -> f64 {
        (self.turns % 4) as f64 * std::f64::consts::FRAC_PI_2
    }

    /// Columns of turns and ranks: zeros for a full tower.
    pub fn columns(cells: &[Self]) -> [Vec<i64>; 2] {
        let before = |index: usize| index.checked_sub(PERIOD).map_or(0, |index| cells[index].turns);
        let turns = (0..cells.len()).map(|index| cells[index].turns - before(index)).collect();
        let ranks = (0..).zip(cells).map(|(index, cell)| cell.rank.wrapping_sub(index)).collect();
        [turns, ranks]
    }

    /// Places of these columns.
    pub fn from_columns([turns, ranks]: [Vec<i64>; 2]) -> Vec<Self> {
        let mut cells: Vec<Self> = Vec::new();
        for (index, (turns, rank)) in turns.into_iter().zip(ranks).enumerate() {
            let before = index.checked_sub(PERIOD).map_or(0, |index| cells[index].turns);
            let turns = before.wrapping_add(turns).rem_euclid(TURNS);
            cells.push(Self { turns, rank: rank.wrapping_add(index as i64) });
        }
        cells
    }

    /// Indices of cells from the bottom to the top.
    pub fn upward(cells: &[Self]) -> Vec<usize> {
        let mut order: Vec<usize> = (0..cells.len()).collect();
        order.sort_by_key(|index| (cells[*index].rank, *index));
        order
    }
}
