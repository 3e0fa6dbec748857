//! Prospect of the next player: to win the game of counting that a tower is.

use crate::blocks::Blocks;
use crate::rules::ideal::IdealPosition;
use crate::rules::table::{Rules, Source, Target};

/// Chance that a move does not end the game before its time.
const GOES_ON: f64 = 0.9;

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
    let is_counted = rules.players == 2
        && rules.source == Source::BelowComplete
        && rules.target == Target::OnTop
        && rules.points.is_none()
        && rules.die.is_none();
    let position = if is_counted { IdealPosition::of(blocks) } else { None };
    let won = position.filter(|position| position.is_won());
    won.map_or(0.0, |position| libm::pow(GOES_ON, f64::from(position.moves_left())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blocks::samples::tower;
    use crate::rules::table::Table;

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
