//! Requirements of section 3.6, each answered by an experiment.

mod dynamics;
mod handling;
mod penetration;
mod robustness;
mod stability;
mod subject;

use indicatif::ProgressBar;
use maud::{Markup, html};
use rayon::prelude::*;
use teeter_dissertation::jenga3d::Constants;

use super::column::{COLUMNS, headings};
use super::frame_rate::frame_rate;
use super::part::Inputs;
use crate::error::Error;
use crate::table::Table;
use subject::{Answer, ROWS, Subject};

/// Requirement with the dissertation's own answer.
struct Requirement {
    number: &'static str,
    text: &'static str,
    /// Answer of the dissertation about its simulator.
    printed: &'static str,
    experiment: fn(&Subject) -> Result<Answer, Error>,
}

const fn requirement(
    number: &'static str,
    text: &'static str,
    printed: &'static str,
    experiment: fn(&Subject) -> Result<Answer, Error>,
) -> Requirement {
    Requirement { number, text, printed, experiment }
}

const REQUIREMENTS: [Requirement; 16] = [
    requirement("1.1", "remove a block", "met", handling::removes),
    requirement("1.2", "place a block on top", "met", handling::lays_on_top),
    requirement("1.3", "analogue input", "met", handling::analogue),
    requirement("1.4", "all sides in view", "met", handling::all_sides),
    requirement("2.1", "gravity", "met", dynamics::gravity),
    requirement("2.2", "friction", "not adequate", dynamics::friction),
    requirement("2.3", "stays up when stable", "met, test 6 with problems", stability::stays),
    requirement("2.4", "collapses when unstable", "met", stability::collapses),
    requirement("2.5", "as expected when a block is removed", "met, some movement", handling::removal_disturbs),
    requirement("2.6", "as expected when a block is placed", "met, some movement", handling::placing_disturbs),
    requirement("2.7", "blocks do not pass through others", "met", penetration::no_passing),
    requirement("2.8", "blocks are not embedded in others", "occasionally", penetration::no_embedding),
    requirement("2.9", "no jitter", "edges fluctuate", stability::no_jitter),
    requirement("3.1", "does not crash or freeze", "met", robustness::no_crash),
    requirement("3.2", "real time, at least 12 frames a second", "met up to 7 rows", robustness::real_time),
    requirement("3.3", "simple and intuitive", "met", handling::simple),
];

/// Number of experiments, timed ones included.
pub const STEPS: u64 = ((REQUIREMENTS.len() + ROWS.len()) * COLUMNS.len()) as u64;

/// Measures the frame rates of all columns, those of a column in turn, frames per second.
pub fn clock(constants: &Constants, bar: &ProgressBar) -> Result<Vec<f64>, Error> {
    let cases = COLUMNS.iter().flat_map(|column| ROWS.map(|rows| (column, rows)));
    cases
        .map(|(column, rows)| {
            let rate = frame_rate(column, constants, rows);
            bar.inc(1);
            rate
        })
        .collect()
}

/// Examines all columns.
pub fn run(Inputs { constants, bar, times, played }: Inputs) -> Result<Markup, Error> {
    let columns = COLUMNS.iter().zip(played).zip(times.chunks(ROWS.len()));
    let subjects: Vec<Subject> =
        columns.map(|((column, moves), rates)| Subject { column, constants, moves, rates }).collect();
    let jobs: Vec<(&Requirement, &Subject)> =
        REQUIREMENTS.iter().flat_map(|requirement| subjects.iter().map(move |s| (requirement, s))).collect();
    let answers: Vec<Answer> = jobs
        .par_iter()
        .map(|(requirement, subject)| {
            let answer = (requirement.experiment)(subject);
            bar.inc(1);
            answer
        })
        .collect::<Result<_, _>>()?;
    let row = |(requirement, answers): (&Requirement, &[Answer])| {
        let name = format!("{} {}", requirement.number, requirement.text);
        let cells = answers.iter().map(|a| format!("{}: {}", a.judgement.word(), a.evidence));
        [name, requirement.printed.to_owned()].into_iter().chain(cells).collect()
    };
    let rows = REQUIREMENTS.iter().zip(answers.chunks(COLUMNS.len())).map(row).collect();
    Ok(html! {
        p {
            "Each is judged by an experiment, where one can: 2.5 and 2.6 by all twelve moves, 3.2 \
             by the frame rates of this machine with the 18 rows at which section 3.5 aims."
        }
        (Table::of_words(headings(["requirement", "dissertation, of itself"]), rows))
    })
}

#[cfg(test)]
mod tests {
    use std::sync::LazyLock;

    use glam::{DQuat, DVec3};
    use teeter_scene::Scene;

    use super::super::backend::{Backend, FrameReport, Grasp};
    use super::super::column::Column;
    use super::super::moves::PLAYED;
    use super::super::played::Played;
    use super::super::tower::{FRAME_RATE, Tower};
    use super::subject::Judgement;
    use super::*;

    static DEFAULT: LazyLock<Constants> = LazyLock::new(Constants::default);

    fn subject<'a>(column: &'static Column, moves: &'a Played) -> Subject<'a> {
        Subject { column, constants: &DEFAULT, moves, rates: &[] }
    }

    /// Checks that exactly these columns do not meet a requirement.
    fn all_meet_except(number: &str, columns: &[&str]) {
        let requirement = REQUIREMENTS.iter().find(|r| r.number == number).expect("there is such a requirement");
        let subjects = COLUMNS.iter().zip(PLAYED.iter()).map(|(column, moves)| subject(column, moves));
        let answers: Vec<Answer> =
            subjects.map(|subject| (requirement.experiment)(&subject).expect("the experiment runs")).collect();
        assert!(answers.iter().all(|answer| answer.judgement != Judgement::NotJudged), "{answers:?}");
        let fail: Vec<&str> = COLUMNS
            .iter()
            .zip(&answers)
            .filter(|(_, a)| a.judgement == Judgement::NotMet)
            .map(|(c, _)| c.name)
            .collect();
        assert_eq!(fail, columns, "{answers:?}");
    }

    /// The report has neither a camera nor users.
    #[test]
    fn requirements_without_an_experiment_are_not_judged() {
        for number in ["1.4", "3.3"] {
            let requirement = REQUIREMENTS.iter().find(|r| r.number == number).expect("there is such a requirement");
            let subject = subject(&COLUMNS[0], &PLAYED[0]);
            let answer = (requirement.experiment)(&subject).expect("there is an answer");
            assert_eq!(answer.judgement, Judgement::NotJudged, "{number}");
        }
    }

    macro_rules! requirement {
        ($name:ident, $number:literal, $columns:expr) => {
            #[test]
            fn $name() {
                all_meet_except($number, &$columns);
            }
        };
    }

    /// Blocks that nothing stops.
    struct Ghost {
        scene: Scene,
        velocities: Vec<DVec3>,
    }

    impl Backend for Ghost {
        fn len(&self) -> usize {
            self.scene.blocks.len()
        }

        fn step(&mut self, hand: Option<&Grasp>) -> FrameReport {
            for (block, velocity) in self.scene.blocks.iter_mut().zip(&self.velocities) {
                block.pos = (DVec3::from(block.pos) + *velocity / FRAME_RATE).to_array();
            }
            if let Some(grasp) = hand {
                self.scene.blocks[grasp.block as usize].pos = grasp.target.to_array();
            }
            FrameReport::default()
        }

        fn corners(&self, block: usize) -> [DVec3; 8] {
            let block = &self.scene.blocks[block];
            let side = |c: usize, bit: usize| if c >> bit & 1 == 1 { 0.5 } else { -0.5 } * block.size[bit];
            let turn = DQuat::from_rotation_z(block.yaw);
            std::array::from_fn(|c| DVec3::from(block.pos) + turn * DVec3::new(side(c, 0), side(c, 1), side(c, 2)))
        }

        fn set_velocity(&mut self, block: usize, velocity: DVec3) {
            self.velocities[block] = velocity;
        }
    }

    #[test]
    fn blocks_that_pass_through_others_do_not_meet_the_requirement() {
        fn ghosts(scene: &Scene, _: &Constants) -> Result<Tower, Error> {
            let velocities = vec![DVec3::ZERO; scene.blocks.len()];
            Ok(Tower::new(Ghost { scene: scene.clone(), velocities }))
        }
        static GHOST: Column = Column { name: "ghost", build: ghosts, awake: ghosts };
        let subject = subject(&GHOST, &PLAYED[0]);
        let answer = penetration::no_passing(&subject).expect("the experiment runs");
        assert_eq!(answer.judgement, Judgement::NotMet);
        // The hand moves to the middle of a block, half its height from its faces.
        let expected = "of 10 throws at up to 10 m/s 10 go through; a hand drives a block 8.";
        assert!(answer.evidence.starts_with(expected), "{}", answer.evidence);
    }

    requirement!(r_1_1_remove_a_block, "1.1", []);
    requirement!(r_1_2_place_a_block, "1.2", []);
    requirement!(r_1_3_analogue_input, "1.3", []);
    requirement!(r_2_1_gravity, "2.1", []);
    requirement!(r_2_2_friction, "2.2", ["2003 method"]);
    requirement!(r_2_3_stays_up, "2.3", ["2003 method", "2003 with 6.3"]);
    requirement!(r_2_4_collapses, "2.4", []);
    requirement!(r_2_5_removal, "2.5", ["2003 method", "2003 with 6.3"]);
    requirement!(r_2_6_placing, "2.6", ["2003 method"]);
    requirement!(r_2_7_no_passing, "2.7", []);
    requirement!(r_2_8_no_embedding, "2.8", []);
    requirement!(r_2_9_no_jitter, "2.9", ["2003 method"]);
    requirement!(r_3_1_no_crash, "3.1", []);
}
