//! Blocks that the rules let a player take.

use teeter_physics::BodyId;

use crate::blocks::Blocks;
use crate::rules::illegal::Illegal;
use crate::rules::table::Source;
use crate::rules::throw::Throw;
use crate::tower_map::{CellId, TowerMap};

/// Cells of a complete row.
const CELLS: usize = 3;

/// Rows of a tower at the beginning of a turn, as far as rules are about them.
pub struct Removal {
    source: Source,
    throw: Option<Throw>,
    cells: Vec<(BodyId, CellId)>,
    /// Highest complete row.
    complete: Option<u32>,
}

impl Removal {
    /// Judges the tower as it stands. A throw that no block meets allows every block.
    pub fn new(blocks: &Blocks, source: Source, throw: Option<Throw>) -> Self {
        let cells = TowerMap::new(blocks, None).cells();
        let is_complete = |row: u32| cells.iter().filter(|(_, cell)| cell.row == row).count() >= CELLS;
        let complete = cells.iter().map(|(_, cell)| cell.row).rev().find(|row| is_complete(*row));
        let mut removal = Self { source, throw, cells, complete };
        if removal.blocks(blocks).is_empty() {
            removal.throw = None;
        }
        removal
    }

    /// Blocks that may be taken, in the order of their ids.
    pub fn blocks(&self, blocks: &Blocks) -> Vec<BodyId> {
        blocks.bodies().filter(|body| self.judge(*body).is_ok()).collect()
    }

    /// Returns the reason why a block may not be taken.
    pub fn judge(&self, body: BodyId) -> Result<(), Illegal> {
        if self.source == Source::Anything {
            return Ok(());
        }
        let cell = self.cells.iter().find(|(other, _)| *other == body).map(|(_, cell)| *cell);
        let cell = cell.ok_or(Illegal::NotInTower { body })?;
        match self.source {
            Source::BelowComplete if self.complete.is_none_or(|row| cell.row >= row) => {
                return Err(Illegal::TooHigh { body });
            }
            Source::AboveFirst if cell.row == 0 => return Err(Illegal::BottomRow { body }),
            _ => {}
        }
        match self.throw {
            Some(throw) if !throw.allows(cell) => Err(Illegal::NotThrown { body }),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blocks::samples::tower;
    use crate::rules::throw::{CellKind, RowKind};

    fn removable(rows: &[&str], source: Source, throw: Option<Throw>) -> Vec<u32> {
        let blocks = tower(rows, 0.3);
        Removal::new(&blocks, source, throw).blocks(&blocks).into_iter().map(|body| body.0).collect()
    }

    #[test]
    fn official_rules_protect_the_highest_complete_row_and_all_above_it() {
        let all = |n: u32| (0..n).collect::<Vec<_>>();
        assert_eq!(removable(&["xxx"; 4], Source::BelowComplete, None), all(9));
        // An unfinished top row protects the complete one under it as well.
        for top in ["x..", ".x.", "xx.", "x.x"] {
            assert_eq!(removable(&["xxx", "xxx", "xxx", top], Source::BelowComplete, None), all(6), "{top}");
        }
        // Rows with gaps below give what is left of them.
        assert_eq!(removable(&["xxx", ".x.", "x.x", "xxx", "x.."], Source::BelowComplete, None), all(6));
        assert_eq!(removable(&["xxx", "x.x"], Source::BelowComplete, None), all(0));
    }

    #[test]
    fn friendly_rules_protect_the_bottom_row_alone_and_free_rules_none() {
        assert_eq!(removable(&["xxx", "xxx", "x.."], Source::AboveFirst, None), [3, 4, 5, 6]);
        assert_eq!(removable(&["xxx", "x.."], Source::Anything, None), [0, 1, 2, 3]);
    }

    #[test]
    fn a_throw_allows_its_rows_and_cells_and_every_block_where_none_meets_it() {
        let throw = |row, cell| Some(Throw { row, cell });
        let rows = ["xxx", ".x.", "xxx"];
        let source = Source::BelowComplete;
        assert_eq!(removable(&rows, source, throw(RowKind::Even, CellKind::Middle)), [1]);
        assert_eq!(removable(&rows, source, throw(RowKind::Even, CellKind::End)), [0, 2]);
        assert_eq!(removable(&rows, source, throw(RowKind::Odd, CellKind::Any)), [3]);
        assert_eq!(removable(&rows, source, throw(RowKind::Odd, CellKind::End)), [0, 1, 2, 3]);
    }

    #[test]
    fn each_refusal_names_its_rule() {
        let blocks = tower(&["xxx", "xxx", "xxx", "x.."], 0.0);
        let judge = |source, body| Removal::new(&blocks, source, None).judge(BodyId(body));
        let body = BodyId;
        assert_eq!(judge(Source::BelowComplete, 9), Err(Illegal::TooHigh { body: body(9) }));
        assert_eq!(judge(Source::BelowComplete, 6), Err(Illegal::TooHigh { body: body(6) }));
        assert_eq!(judge(Source::AboveFirst, 2), Err(Illegal::BottomRow { body: body(2) }));
        assert_eq!(judge(Source::BelowComplete, 5), Ok(()));
        let thrown = Throw { row: RowKind::Odd, cell: CellKind::Any };
        let removal = Removal::new(&blocks, Source::BelowComplete, Some(thrown));
        assert_eq!(removal.judge(body(0)), Err(Illegal::NotThrown { body: body(0) }));
    }
}
