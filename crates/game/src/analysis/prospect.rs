//! Prospect of the next player: to win the game of counting that a tower is.

use teeter_physics::BodyId;

use crate::blocks::Blocks;
use crate::rules::ideal::{IdealMove, IdealPosition};
use crate::rules::table::{Rules, Source, Target};

/// Chance that a move does not end the game before its time, on a low tower.
const GOES_ON: f64 = 0.8;

/// Returns the chance, 0 to 1, that counting moves wins the game for the player whose turn it is: 0
/// where the ideal game is lost, and else the chance that it is played out. It is 0 by rules that
/// are not those of the ideal game.
///
/// ```
/// use teeter_game::{Blocks, Rules, Table, prospect};
/// use teeter_physics::{Params, World};
///
/// let rules = Rules::of(Table::Official, 2);
/// // who plays second wins the ideal game of 18 rows
/// let world = World::new(&teeter_scene::named("tower").unwrap(), Params::default())?;
/// assert_eq!(prospect(&Blocks::of(&world), &rules), 0.0);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub fn prospect(blocks: &Blocks, rules: &Rules) -> f64 {
    let position = if is_counted(rules) { IdealPosition::of(blocks) } else { None };
    position.map_or(0.0, chance)
}

/// Returns the prospect of the next player after a block is taken and put on top; 1 where the rest
/// of its row does not stand, and 0 by rules that are not those of the ideal game.
pub fn prospect_after(blocks: &Blocks, rules: &Rules, body: BodyId) -> f64 {
    let position = if is_counted(rules) { IdealPosition::of(blocks) } else { None };
    position.map_or(0.0, |position| {
        IdealMove::of(blocks, body).and_then(|chosen| position.after(chosen)).map_or(1.0, chance)
    })
}

/// Returns true if the rules are those of the ideal game.
fn is_counted(rules: &Rules) -> bool {
    rules.players == 2
        && rules.source == Source::BelowComplete
        && rules.target == Target::OnTop
        && rules.points.is_none()
        && rules.die.is_none()
}

/// Chance that counting moves wins the game from a position.
fn chance(position: IdealPosition) -> f64 {
    if position.is_won() { libm::pow(GOES_ON, f64::from(position.moves_left())) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blocks::samples::tower;
    use crate::rules::table::Table;

    #[test]
    fn the_prospect_after_a_move_is_that_of_the_tower_without_the_block_and_with_it_on_top() {
        let official = Rules::of(Table::Official, 2);
        let before = tower(&["xx.", "xxx", "xxx", "xxx", "x"], 0.0);
        let after = |body: u32| prospect_after(&before, &official, BodyId(body));
        let of = |rows: &[&str]| prospect(&tower(rows, 0.0), &official);
        assert_eq!(after(0), of(&[".x.", "xxx", "xxx", "xxx", "xx"]));
        assert_eq!(after(2), of(&["xx.", ".xx", "xxx", "xxx", "xx"]));
        assert_eq!(after(3), of(&["xx.", "x.x", "xxx", "xxx", "xx"]));
        // The end of the first row does not bear the others.
        assert_eq!(after(1), 1.0);
        assert_eq!(prospect_after(&before, &Rules::of(Table::Solo, 1), BodyId(0)), 0.0);
    }

    #[test]
    fn a_won_game_counts_more_the_sooner_it_ends_and_by_no_other_rules() {
        let official = Rules::of(Table::Official, 2);
        let of = |rows: &[&str], rules: &Rules| prospect(&tower(rows, 0.0), rules);
        // One move is left, then none.
        assert_eq!(of(&["xx.", "xxx"], &official), GOES_ON);
        assert_eq!(of(&[".x.", "xxx"], &official), 0.0);
        let (short, long) = (of(&["xxx"; 2], &official), of(&["xxx"; 5], &official));
        assert!(short > long && long > 0.0, "{short} {long}");
        assert_eq!(of(&["xx.", "xxx"], &Rules::of(Table::Official, 3)), 0.0);
        assert_eq!(of(&["xx.", "xxx"], &Rules::of(Table::Solo, 1)), 0.0);
    }
}
