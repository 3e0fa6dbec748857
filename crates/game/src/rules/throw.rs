//! The die of Throw 'n Go: which rows, and the middle or an end of one.

use serde::{Deserialize, Serialize};
use teeter_scene::Random;

use crate::tower_map::CellId;

/// Rows that a throw allows.
///
/// ```
/// use teeter_game::RowKind;
///
/// assert_eq!(serde_json::to_string(&RowKind::Even)?, r#""even""#);
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RowKind {
    /// Rows that lie as the bottom one does.
    Even,
    /// Rows across it.
    Odd,
}

/// Cells of a row that a throw allows.
///
/// ```
/// use teeter_game::CellKind;
///
/// assert_eq!(serde_json::to_string(&CellKind::End)?, r#""end""#);
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CellKind {
    /// The middle one.
    Middle,
    /// The two at the ends of the row.
    End,
    /// All three.
    Any,
}

/// Face of the die.
///
/// ```
/// use teeter_game::{CellId, CellKind, RowKind, Throw};
///
/// let throw = Throw { row: RowKind::Odd, cell: CellKind::Middle };
/// assert!(throw.allows(CellId { row: 3, cell: 1 }));
/// assert!(!throw.allows(CellId { row: 3, cell: 0 }) && !throw.allows(CellId { row: 2, cell: 1 }));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Throw {
    /// Rows.
    pub row: RowKind,
    /// Cells.
    pub cell: CellKind,
}

impl Throw {
    /// The six faces.
    pub const FACES: [Self; 6] = [
        Self { row: RowKind::Even, cell: CellKind::Middle },
        Self { row: RowKind::Even, cell: CellKind::End },
        Self { row: RowKind::Even, cell: CellKind::Any },
        Self { row: RowKind::Odd, cell: CellKind::Middle },
        Self { row: RowKind::Odd, cell: CellKind::End },
        Self { row: RowKind::Odd, cell: CellKind::Any },
    ];

    /// The throw of a turn, counted from 1, with a die of this seed.
    pub fn of(seed: u64, turn: u32) -> Self {
        let mut random = Random::new(seed ^ Random::new(u64::from(turn)).bits());
        Self::FACES[random.below(Self::FACES.len())]
    }

    /// Returns true if a block of this cell may be taken.
    pub fn allows(self, cell: CellId) -> bool {
        let row = if cell.row.is_multiple_of(2) { RowKind::Even } else { RowKind::Odd };
        let is_middle = cell.cell == 1;
        row == self.row
            && match self.cell {
                CellKind::Middle => is_middle,
                CellKind::End => !is_middle,
                CellKind::Any => true,
            }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_face_comes_up_about_equally_often_and_a_seed_repeats_its_throws() {
        let mut counts = [0; 6];
        for turn in 1..=6000 {
            let throw = Throw::of(7, turn);
            assert_eq!(throw, Throw::of(7, turn));
            counts[Throw::FACES.iter().position(|face| *face == throw).unwrap()] += 1;
        }
        // Five standard deviations of a binomial count.
        assert!(counts.iter().all(|count| (1000i32 - count).abs() < 145), "{counts:?}");
        assert!((1..20).any(|turn| Throw::of(7, turn) != Throw::of(8, turn)));
    }
}
