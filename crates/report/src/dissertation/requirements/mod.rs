//! Requirements of section 3.6, each answered by an experiment.

mod dynamics;
mod handling;
mod oriented_box;
mod overlap;
mod penetration;
mod robustness;
mod stability;
mod subject;
mod view;

use indicatif::ProgressBar;
use maud::{Markup, Render};
use rayon::prelude::*;

use super::column::{COLUMNS, headings};
use crate::error::Error;
use crate::table::Table;
use subject::{Answer, Subject};

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
    requirement("1.4", "all sides in view", "met", view::all_sides),
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
    requirement("3.2", "at least 12 frames a second", "met up to 7 rows", robustness::real_time),
    requirement("3.3", "simple and intuitive", "met", handling::simple),
];

/// Number of experiments, with the moves of each column.
pub const STEPS: u64 = ((REQUIREMENTS.len() + 1) * COLUMNS.len()) as u64;

/// Examines all columns.
pub fn run(bar: &ProgressBar) -> Result<Markup, Error> {
    let subjects: Vec<Subject> = COLUMNS
        .par_iter()
        .map(|column| {
            let subject = Subject::new(column);
            bar.inc(1);
            subject
        })
        .collect::<Result<_, _>>()?;
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
        let cells = answers.iter().map(|a| format!("{}: {}", if a.met { "met" } else { "NOT MET" }, a.evidence));
        [name, requirement.printed.to_owned()].into_iter().chain(cells).collect()
    };
    let rows = REQUIREMENTS.iter().zip(answers.chunks(COLUMNS.len())).map(row).collect();
    Ok(Table::of_words(headings(["requirement", "dissertation, of itself"]), rows).render())
}

#[cfg(test)]
mod tests {
    use std::sync::LazyLock;

    use glam::{DQuat, DVec3};
    use rayon::prelude::*;
    use teeter_scene::Scene;

    use super::super::backend::{Backend, FrameReport, Grasp};
    use super::super::column::Column;
    use super::super::tower::{FRAME_RATE, Tower};
    use super::*;

    /// Columns with their moves, played once for all tests.
    static SUBJECTS: LazyLock<Vec<Subject>> = LazyLock::new(|| {
        COLUMNS.par_iter().map(|column| Subject::new(column).expect("the moves are played")).collect()
    });

    /// Checks that exactly these columns do not meet a requirement.
    fn all_meet_except(number: &str, columns: &[&str]) {
        let requirement = REQUIREMENTS.iter().find(|r| r.number == number).expect("there is such a requirement");
        let answers: Vec<Answer> =
            SUBJECTS.iter().map(|subject| (requirement.experiment)(subject).expect("the experiment runs")).collect();
        let fail: Vec<&str> = COLUMNS.iter().zip(&answers).filter(|(_, a)| !a.met).map(|(c, _)| c.name).collect();
        assert_eq!(fail, columns, "{answers:?}");
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
        static GHOST: Column = Column {
            name: "ghost",
            build: |scene| {
                let velocities = vec![DVec3::ZERO; scene.blocks.len()];
                Ok(Tower::new(Ghost { scene: scene.clone(), velocities }))
            },
        };
        let subject = Subject { column: &GHOST, moves: Vec::new(), max_depth: 0.0 };
        let answer = penetration::no_passing(&subject).expect("the experiment runs");
        assert!(!answer.met);
        // The hand moves to the middle of a block, half its height from its faces.
        let expected = "of 10 throws at up to 10 m/s 10 go through; a hand drives a block 8.";
        assert!(answer.evidence.starts_with(expected), "{}", answer.evidence);
    }

    requirement!(r_1_1_remove_a_block, "1.1", []);
    requirement!(r_1_2_place_a_block, "1.2", []);
    requirement!(r_1_3_analogue_input, "1.3", []);
    requirement!(r_1_4_all_sides_in_view, "1.4", []);
    requirement!(r_2_1_gravity, "2.1", []);
    requirement!(r_2_2_friction, "2.2", ["2003 method"]);
    requirement!(r_2_3_stays_up, "2.3", ["2003 method", "2003 with 6.3"]);
    requirement!(r_2_4_collapses, "2.4", []);
    requirement!(r_2_5_removal, "2.5", ["2003 method"]);
    requirement!(r_2_6_placing, "2.6", []);
    requirement!(r_2_7_no_passing, "2.7", []);
    requirement!(r_2_8_no_embedding, "2.8", []);
    requirement!(r_2_9_no_jitter, "2.9", ["2003 method"]);
    requirement!(r_3_1_no_crash, "3.1", []);
    requirement!(r_3_2_real_time, "3.2", []);
    requirement!(r_3_3_simple, "3.3", []);
}
