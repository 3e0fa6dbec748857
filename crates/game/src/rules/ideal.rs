//! The ideal game: every row stands while its middle block or both its ends are left, and no hand
//! errs. Then the game is one of counting, with an exact winner.
//!
//! A complete row below the highest complete one gives either one block, its middle, or two, an end
//! and then the other beside it. So a position is the number of complete rows that may be taken
//! from, the number of rows that gave one end, and the blocks of the unfinished top row. A player
//! who can take no block without felling the tower loses.
//!
//! Uri Zwick, "Jenga", Proceedings of the 13th Annual ACM-SIAM Symposium on Discrete Algorithms,
//! 2002, pages 243 to 246.

use std::collections::BTreeMap;

use serde::Serialize;

use teeter_physics::BodyId;

use crate::blocks::Blocks;
use crate::tower_map::TowerMap;

/// Blocks of a complete row.
const CELLS: u32 = 3;
/// Maximum number of rows that give blocks: a game has at most six moves for each.
const MAX_ROWS: u32 = 256;

/// Position of the ideal game.
///
/// ```
/// use teeter_game::IdealPosition;
///
/// // with 18 rows the second player wins
/// assert!(!IdealPosition::tower(18).is_won());
/// assert_eq!(IdealPosition::tower(18).winning_move(), None);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct IdealPosition {
    complete: u32,
    one_ended: u32,
    top: u32,
}

/// Move of the ideal game.
///
/// ```
/// use teeter_game::{IdealMove, IdealPosition};
///
/// let position = IdealPosition::new(0, 1, 0).unwrap();
/// assert_eq!(position.winning_move(), Some(IdealMove::SecondEnd));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum IdealMove {
    /// The middle of a complete row.
    Middle,
    /// An end of a complete row.
    FirstEnd,
    /// The end that is left beside a middle block.
    SecondEnd,
}

impl IdealMove {
    const ALL: [Self; 3] = [Self::Middle, Self::FirstEnd, Self::SecondEnd];

    /// The move that takes a block of a tower as it stands. None where the rest of its row does not
    /// bear what is above.
    pub fn of(blocks: &Blocks, body: BodyId) -> Option<Self> {
        let cells = TowerMap::new(blocks, None).cells();
        let (_, at) = *cells.iter().find(|(other, _)| *other == body)?;
        let mut row = [false; 3];
        cells.iter().filter(|(_, cell)| cell.row == at.row).for_each(|(_, cell)| row[cell.cell as usize] = true);
        match (row, at.cell) {
            ([true, true, true], 1) => Some(Self::Middle),
            ([true, true, true], _) => Some(Self::FirstEnd),
            ([true, true, false], 0) | ([false, true, true], 2) => Some(Self::SecondEnd),
            _ => None,
        }
    }
}

impl IdealPosition {
    /// A position of `complete` rows below the highest complete one, `one_ended` rows of a middle
    /// block and one end, and `top` blocks of the unfinished top row. None where there are more
    /// than 256 rows, or more than two blocks in the top row.
    pub fn new(complete: u32, one_ended: u32, top: u32) -> Option<Self> {
        let is_possible = complete.saturating_add(one_ended) <= MAX_ROWS && top < CELLS;
        is_possible.then_some(Self { complete, one_ended, top })
    }

    /// A full tower of `rows` rows, at most 257.
    pub fn tower(rows: u32) -> Self {
        Self { complete: rows.saturating_sub(1).min(MAX_ROWS), one_ended: 0, top: 0 }
    }

    /// The position of a tower as it stands. None where it has no complete row, or more rows than
    /// the game is solved for.
    pub fn of(blocks: &Blocks) -> Option<Self> {
        let mut rows: BTreeMap<u32, [bool; 3]> = BTreeMap::new();
        for (_, cell) in TowerMap::new(blocks, None).cells() {
            rows.entry(cell.row).or_default()[cell.cell as usize] = true;
        }
        let protected = *rows.iter().rev().find(|(_, row)| **row == [true; 3])?.0;
        let count = |is_counted: fn(&[bool; 3]) -> bool| {
            rows.range(..protected).filter(|(_, row)| is_counted(row)).count() as u32
        };
        let top = rows.range(protected + 1..).map(|(_, row)| row.iter().filter(|cell| **cell).count() as u32).sum();
        Self::new(count(|row| *row == [true; 3]), count(|row| row[1] && row[0] != row[2]), top)
    }

    /// Number of moves until none is left, if each takes an end.
    pub fn moves_left(self) -> u32 {
        let Self { complete, one_ended, top } = self;
        let mut left = 2 * complete + one_ended;
        let (mut moves, mut top) = (0, top);
        while left > 0 {
            (left, moves, top) = (left - 1, moves + 1, top + 1);
            if top == CELLS {
                (left, top) = (left + 2, 0);
            }
        }
        moves
    }

    /// The position after a move; none where no block allows it.
    pub fn after(self, chosen: IdealMove) -> Option<Self> {
        let Self { complete, one_ended, top } = self;
        let (complete, one_ended) = match chosen {
            IdealMove::Middle => (complete.checked_sub(1)?, one_ended),
            IdealMove::FirstEnd => (complete.checked_sub(1)?, one_ended + 1),
            IdealMove::SecondEnd => (complete, one_ended.checked_sub(1)?),
        };
        // A row that is completed protects itself, and the one that it protects no more counts.
        let is_complete = top + 1 >= CELLS;
        let (complete, top) = if is_complete { (complete + 1, 0) } else { (complete, top + 1) };
        Some(Self { complete, one_ended, top })
    }

    /// Returns true if the player to move wins.
    pub fn is_won(self) -> bool {
        self.winning_move().is_some()
    }

    /// A move after which the other player loses; none where there is none.
    pub fn winning_move(self) -> Option<IdealMove> {
        Solution::default().winning_move(self)
    }
}

/// Winners of the positions met so far.
#[derive(Default)]
struct Solution(BTreeMap<IdealPosition, bool>);

impl Solution {
    /// Returns true if the player to move wins. Each move leaves fewer moves: the recursion ends.
    fn is_won(&mut self, position: IdealPosition) -> bool {
        if let Some(is_won) = self.0.get(&position) {
            return *is_won;
        }
        let is_won = self.winning_move(position).is_some();
        self.0.insert(position, is_won);
        is_won
    }

    fn winning_move(&mut self, position: IdealPosition) -> Option<IdealMove> {
        IdealMove::ALL.into_iter().find(|chosen| position.after(*chosen).is_some_and(|next| !self.is_won(next)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blocks::samples::tower;

    #[test]
    fn the_first_player_wins_a_tower_of_two_rows_and_those_of_four_or_more_that_three_does_not_divide() {
        for rows in 1..=40 {
            let is_expected = rows == 2 || (rows >= 4 && rows % 3 != 0);
            assert_eq!(IdealPosition::tower(rows).is_won(), is_expected, "{rows} rows");
        }
    }

    #[test]
    fn a_position_is_read_off_a_tower() {
        let of = |rows: &[&str]| IdealPosition::of(&tower(rows, 0.0));
        for rows in 1..8 {
            assert_eq!(of(&vec!["xxx"; rows]), Some(IdealPosition::tower(rows as u32)), "{rows} rows");
        }
        // Of these rows the second and third give one end, the first and fourth nothing.
        let rows = ["x.x", "xx.", ".xx", ".x.", "xxx", "xxx", ".xx"];
        assert_eq!(of(&rows), IdealPosition::new(1, 2, 2));
        assert_eq!(of(&["xx.", "xx."]), None);
    }

    #[test]
    fn the_moves_that_are_left_are_those_of_the_longest_game() {
        fn longest(position: IdealPosition, known: &mut BTreeMap<IdealPosition, u32>) -> u32 {
            if let Some(moves) = known.get(&position) {
                return *moves;
            }
            let next = IdealMove::ALL.into_iter().filter_map(|chosen| position.after(chosen));
            let moves = next.map(|next| 1 + longest(next, known)).max().unwrap_or(0);
            known.insert(position, moves);
            moves
        }
        let mut known = BTreeMap::new();
        for complete in 0..9 {
            for one_ended in 0..6 {
                for top in 0..3 {
                    let position = IdealPosition { complete, one_ended, top };
                    assert_eq!(position.moves_left(), longest(position, &mut known), "{position:?}");
                }
            }
        }
    }

    #[test]
    fn short_games_are_those_played_out_by_hand() {
        // No block may be taken: who must move loses.
        assert!(!IdealPosition::tower(0).is_won() && !IdealPosition::tower(1).is_won());
        // The only row gives its middle, and the other player has none.
        assert_eq!(IdealPosition::tower(2).winning_move(), Some(IdealMove::Middle));
        // Two ends are left in turn: the second player takes the last.
        let two = IdealPosition { complete: 0, one_ended: 2, top: 0 };
        assert!(!two.is_won());
        // With two blocks on top already the first of them completes a row, which gives one more.
        let completing = IdealPosition { complete: 0, one_ended: 1, top: 2 };
        let after = completing.after(IdealMove::SecondEnd).unwrap();
        assert_eq!(after, IdealPosition { complete: 1, one_ended: 0, top: 0 });
        assert!(after.is_won() && !completing.is_won());
    }

    #[test]
    fn a_winning_move_leads_to_a_lost_position_and_a_lost_position_has_none() {
        for complete in 0..7 {
            for one_ended in 0..7 {
                for top in 0..3 {
                    let position = IdealPosition { complete, one_ended, top };
                    match position.winning_move() {
                        Some(chosen) => assert!(!position.after(chosen).unwrap().is_won(), "{position:?}"),
                        None => {
                            let mut next = IdealMove::ALL.into_iter().filter_map(|chosen| position.after(chosen));
                            assert!(next.all(IdealPosition::is_won), "{position:?}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn the_second_player_who_answers_by_the_table_wins_from_eighteen_rows_against_any_play() {
        let mut random = teeter_scene::Random::new(3);
        for _ in 0..20 {
            let mut position = IdealPosition::tower(18);
            for turn in 0.. {
                let legal: Vec<IdealMove> =
                    IdealMove::ALL.into_iter().filter(|chosen| position.after(*chosen).is_some()).collect();
                if legal.is_empty() {
                    assert_eq!(turn % 2, 0, "the first player is left without a move");
                    break;
                }
                let any = legal[random.below(legal.len())];
                let chosen = if turn % 2 == 0 { any } else { position.winning_move().expect("the second player wins") };
                position = position.after(chosen).unwrap();
            }
        }
    }
}
