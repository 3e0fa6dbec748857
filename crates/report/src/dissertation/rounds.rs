//! Central claim of the dissertation: all collisions are resolved within a couple of iterations
//! (abstract, sections 3.4.2 and 6.2.2), and the order of the pairs (section 3.3.4).

use maud::{Markup, html};
use rayon::prelude::*;
use teeter_dissertation::jenga3d::counters::Rounds;
use teeter_dissertation::jenga3d::{Constants, Disabling, Order};
use teeter_scene::{Scene, TowerOptions, tower};

use super::column::{COLUMNS, Column};
use super::moves::{STEPS_OF_COLUMN, play_column};
use super::part::Inputs;
use super::played::Played;
use super::springs::Springs;
use super::tower::{FRAME_RATE, Tower};
use crate::error::Error;
use crate::table::Table;

/// Orders of the pairs.
const ORDERS: [(Order, &str); 3] =
    [(Order::Naive, "as created"), (Order::BottomUp, "bottom to top"), (Order::TopDown, "top to bottom")];
/// Heights of the towers whose pairs are ordered, rows.
const ROWS: [u32; 2] = [6, 18];
/// Number of experiments, without the moves of the columns.
pub const STEPS: u64 = STEPS_OF_COLUMN + (ORDERS.len() * ROWS.len()) as u64;
/// Calls of `CollideBlocks` in a step.
const CALLS: u64 = 2;
/// Column of the 2003 method without disabling.
const NEVER_DISABLED: Column =
    Column { name: "2003 method, nothing disabled", build: never_disabled, awake: never_disabled };

fn never_disabled(scene: &Scene, constants: &Constants) -> Result<Tower, Error> {
    let constants = Constants { disabling: Disabling::Off, ..constants.clone() };
    Ok(Tower::new(Springs::new(scene, constants)?))
}

/// Counts of a tower in its first second, nothing disabled.
fn settle(constants: &Constants, order: Order, rows: u32) -> Result<Rounds, Error> {
    let scene = tower(&TowerOptions { rows, ..TowerOptions::default() })?;
    let constants = Constants { order, disabling: Disabling::Off, ..constants.clone() };
    let mut tower = Tower::new(Springs::new(&scene, constants)?);
    tower.rest(FRAME_RATE as u32);
    Ok(tower.rounds())
}

/// Share of all steps, as text.
fn percent(part: u64, all: u64) -> String {
    format!("{:.1} %", 100.0 * part as f64 / all.max(1) as f64)
}

/// Calls of at most three rounds: two that find collisions, and one that finds none.
fn couple(rounds: &Rounds) -> u64 {
    rounds.calls_by_rounds[..3].iter().sum()
}

/// Row of a column that has played the moves.
fn row(name: &str, played: &Played) -> Vec<String> {
    let Played { outcomes, rounds, frames, .. } = played;
    let of = |part: u64, all: u64| format!("{part} of {all}");
    vec![
        name.to_owned(),
        outcomes.len().to_string(),
        format!("{:.2}", rounds.mean()),
        percent(couple(rounds), rounds.calls),
        rounds.max.to_string(),
        of(rounds.unresolved, rounds.calls),
        of(rounds.unresolved_steps, rounds.calls / CALLS),
        of(rounds.unresolved_frames, *frames),
    ]
}

/// Counts the rounds.
pub fn run(Inputs { constants, bar, played, .. }: Inputs) -> Result<Markup, Error> {
    let never_disabled = play_column(&NEVER_DISABLED, constants, bar)?;
    let columns =
        [(COLUMNS[0].name, &played[0]), (NEVER_DISABLED.name, &never_disabled), (COLUMNS[1].name, &played[1])];
    let rows = columns.map(|(name, played)| row(name, played)).to_vec();
    let cases: Vec<(Order, u32)> = ROWS.iter().flat_map(|rows| ORDERS.map(|(order, _)| (order, *rows))).collect();
    let settled: Vec<Rounds> = cases
        .par_iter()
        .map(|(order, rows)| {
            let counts = settle(constants, *order, *rows);
            bar.inc(1);
            counts
        })
        .collect::<Result<_, Error>>()?;
    let head = [
        "twelve moves",
        "moves until the end or a fall",
        "rounds a call, mean",
        "calls of at most three",
        "maximum",
        "calls that end with collisions left",
        "steps with such a call",
        "frames with such a call",
    ];
    let limit = constants.max_sweeps;
    Ok(html! {
        p {
            "\"All collisions are guaranteed to be solved within just a couple of iterations\" \
             (6.2.2). An iteration is a round over the pairs; the last of a call finds nothing, so \
             a couple are at most three. A call of " code { "CollideBlocks" } " stops after \
             " (limit) " rounds, with collisions left."
        }
        (Table::new(head, rows))
        (answer(constants.disabling, [&played[0].rounds, &never_disabled.rounds, &played[1].rounds]))
        (orders(&settled))
    })
}

/// Answer to the claim, from the rounds of the method under a rule of disabling, of the same with
/// nothing disabled, and with 6.3.
fn answer(rule: Disabling, [with_rule, never_disabled, with_future_work]: [&Rounds; 3]) -> Markup {
    let is_to_blame = rule == Disabling::Listed && with_rule.unresolved > 0 && never_disabled.unresolved == 0;
    let outcome = |rounds: &Rounds| match rounds.unresolved {
        0 => format!("no collision is left, within {} rounds", rounds.max),
        calls => format!("{calls} calls end with collisions left"),
    };
    html! {
        p {
            @if is_to_blame {
                "The claim fails in play, and the disabling of appendix 2.5 is why. Springs yield, \
                 but a disabled block is immovable in the second call: a blow there turns back its \
                 neighbour alone, and the block keeps its velocity, with which it goes on once it is \
                 enabled. So it is not the second call that is the first to fail, but the first one \
                 of a later step, in which all of these velocities meet. "
            } @else {
                "With the rule of disabling, " (rule.name()) ", " (outcome(with_rule)) ". "
            }
            "With nothing disabled " (outcome(never_disabled)) ". With blocks that are disabled only \
             at rest and stay so (6.3) " (outcome(with_future_work)) "."
        }
    }
}

/// Table of the orders, from the counts of each height in turn.
fn orders(settled: &[Rounds]) -> Markup {
    let cell = |counts: &Rounds| format!("{:.2}, {} at most", counts.mean(), counts.max);
    let row = |(n, (_, name)): (usize, &(Order, &str))| {
        let counts = settled.iter().skip(n).step_by(ORDERS.len());
        std::iter::once((*name).to_owned()).chain(counts.map(cell)).collect()
    };
    let head =
        std::iter::once("order of pairs".to_owned()).chain(ROWS.map(|rows| format!("{rows} rows: rounds a call")));
    let rows = ORDERS.iter().enumerate().map(row).collect();
    html! {
        p {
            "Section 3.3.4 asks whether the order of the pairs saves rounds. Towers in their first \
             second, as the rows fall onto each other and settle, nothing disabled:"
        }
        (Table::new(head, rows))
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use glam::DVec3;
    use indicatif::ProgressBar;
    use teeter_dissertation::jenga3d::Hand;

    use super::super::backend::{Backend, FrameReport, Grasp};
    use super::super::moves::PLAYED;
    use super::*;

    /// Disabled blocks are immovable in the second call, and that alone leaves collisions.
    #[test]
    fn only_disabled_blocks_leave_collisions_in_play() {
        let never_disabled =
            play_column(&NEVER_DISABLED, &Constants::default(), &ProgressBar::hidden()).expect("the moves are played");
        assert!(PLAYED[0].rounds.unresolved > 0, "{:?}", PLAYED[0].rounds);
        for (name, rounds) in [("none disabled", never_disabled.rounds), ("with 6.3", PLAYED[1].rounds)] {
            assert_eq!((rounds.unresolved, rounds.unresolved_steps), (0, 0), "{name}");
            assert!(rounds.calls > 200_000, "{name}: {rounds:?}");
        }
        // A couple of rounds that find collisions, and the one that finds none.
        let few = never_disabled.rounds;
        assert!(few.max <= 4 && couple(&few) as f64 > 0.999 * few.calls as f64, "{few:?}");
    }

    /// The reason is given where it was measured, and nowhere else.
    #[test]
    fn disabling_is_blamed_only_where_collisions_are_left_with_it_alone() {
        let left = |unresolved| Rounds { unresolved, max: 4, ..Rounds::default() };
        let answer = |rule, counts: [u64; 3]| {
            let [a, b, c] = counts.map(left);
            answer(rule, [&a, &b, &c]).into_string()
        };
        let text = answer(Disabling::Listed, [5, 0, 0]);
        assert!(
            text.contains("appendix 2.5 is why") && text.contains("nothing disabled no collision is left, within 4")
        );
        for (rule, counts) in
            [(Disabling::Off, [5, 0, 0]), (Disabling::Listed, [0, 0, 0]), (Disabling::Listed, [5, 2, 0])]
        {
            let text = answer(rule, counts);
            assert!(!text.contains("is why"), "{rule:?} {counts:?}: {text}");
        }
        assert!(answer(Disabling::Listed, [5, 2, 0]).contains("nothing disabled 2 calls end with collisions left"));
    }

    /// Runs of steps with collisions left, and those of them that the second call began.
    static BEGINNINGS: Mutex<(u32, u32)> = Mutex::new((0, 0));

    /// Simulator of 2003 that repeats the first step of each such run with nothing disabled: its
    /// first call is then the same.
    struct Probe {
        springs: Springs,
        in_run: bool,
    }

    impl Probe {
        fn step(&mut self, hand: Option<&Hand>) {
            let mut repeated = self.springs.0.clone();
            let left = self.springs.0.step(hand).unresolved > 0;
            if left && !self.in_run {
                repeated.constants.disabling = Disabling::Off;
                let mut beginnings = BEGINNINGS.lock().expect("nobody panics with it");
                beginnings.0 += 1;
                beginnings.1 += u32::from(repeated.step(hand).unresolved == 0);
            }
            self.in_run = left;
        }
    }

    impl Backend for Probe {
        fn len(&self) -> usize {
            self.springs.len()
        }

        fn step(&mut self, hand: Option<&Grasp>) -> FrameReport {
            let hand = hand.map(|grasp| Hand { block: grasp.block, target: grasp.target });
            for _ in 0..self.springs.0.constants.mid_loop_count {
                self.step(hand.as_ref());
            }
            FrameReport::default()
        }

        fn corners(&self, block: usize) -> [DVec3; 8] {
            self.springs.corners(block)
        }

        fn set_velocity(&mut self, block: usize, velocity: DVec3) {
            self.springs.set_velocity(block, velocity);
        }
    }

    /// The first call of a step, in which every block is enabled, is the first to leave a
    /// collision: the second calls before have left velocities.
    #[test]
    fn the_first_call_of_a_step_is_the_first_to_leave_collisions() {
        fn probe(scene: &Scene, constants: &Constants) -> Result<Tower, Error> {
            Ok(Tower::new(Probe { springs: Springs::new(scene, constants.clone())?, in_run: false }))
        }
        let column = Column { name: "probe", build: probe, awake: probe };
        play_column(&column, &Constants::default(), &ProgressBar::hidden()).expect("the moves are played");
        let (runs, by_second) = *BEGINNINGS.lock().expect("nobody panics with it");
        assert!(runs > 50, "{runs}");
        assert_eq!(by_second, 0, "of {runs}");
    }
}
