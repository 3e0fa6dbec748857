//! The requirements of section 3.6, each answered by an experiment.

use glam::DVec3;
use indicatif::ProgressBar;
use rayon::prelude::*;
use teeter_dissertation::jenga3d::pick::Camera;
use teeter_scene::{Scene, TowerOptions, named, tower};

use super::column::{COLUMNS, Column, FRAMES, Grasp, Tower};
use super::page::{mm, table_of_words};
use super::{frame_rate, moves, statics};
use crate::fault::Fault;

/// What an experiment showed.
#[derive(Debug, Clone)]
pub struct Answer {
    /// Whether the requirement is met.
    pub met: bool,
    /// The figure behind it.
    pub evidence: String,
}

/// What is asked: a column, and what its first six moves did, for the requirements that are about moves.
pub struct Subject {
    column: &'static Column,
    moves: Vec<moves::Outcome>,
    /// How deep any block was in another after any of the moves, m.
    embedded: f64,
}

impl Subject {
    /// Plays the moves.
    pub fn new(column: &'static Column) -> Result<Self, Fault> {
        let (mut outcomes, mut embedded) = (Vec::new(), 0.0f64);
        moves::play(column, 6, |tower, outcome| {
            embedded = embedded.max(deepest(tower));
            outcomes.push(outcome);
        })?;
        Ok(Self { column, moves: outcomes, embedded })
    }

    fn build(&self, scene: &Scene) -> Result<Box<dyn Tower>, Fault> {
        (self.column.build)(scene)
    }
}

fn answer(met: bool, evidence: String) -> Result<Answer, Fault> {
    Ok(Answer { met, evidence })
}

/// A requirement.
pub struct Requirement {
    /// Its number.
    pub number: &'static str,
    text: &'static str,
    /// What the dissertation says of itself.
    printed: &'static str,
    /// The experiment.
    pub ask: fn(&Subject) -> Result<Answer, Fault>,
}

const fn requirement(
    number: &'static str,
    text: &'static str,
    printed: &'static str,
    ask: fn(&Subject) -> Result<Answer, Fault>,
) -> Requirement {
    Requirement { number, text, printed, ask }
}

/// All of them.
pub const REQUIREMENTS: [Requirement; 16] = [
    requirement("1.1", "remove a block", "met", removes),
    requirement("1.2", "place a block on top", "met", places),
    requirement("1.3", "analogue input", "met", analogue),
    requirement("1.4", "all sides in view", "met", all_sides),
    requirement("2.1", "gravity", "met", gravity),
    requirement("2.2", "friction", "not adequate", friction),
    requirement("2.3", "stays up when stable", "met, test 6 with problems", stays),
    requirement("2.4", "collapses when unstable", "met", collapses),
    requirement("2.5", "as expected when a block is removed", "met, some movement", removal_disturbs),
    requirement("2.6", "as expected when a block is placed", "met, some movement", placing_disturbs),
    requirement("2.7", "blocks do not pass through others", "met", no_passing),
    requirement("2.8", "blocks are not embedded in others", "occasionally", no_embedding),
    requirement("2.9", "no jitter", "edges fluctuate", no_jitter),
    requirement("3.1", "does not crash or freeze", "met", no_crash),
    requirement("3.2", "at least 12 frames a second", "met up to 7 rows", real_time),
    requirement("3.3", "simple and intuitive", "met", simple),
];

/// Experiments.
pub const STEPS: u64 = ((REQUIREMENTS.len() + 1) * COLUMNS.len()) as u64;

/// Runs them.
pub fn run(bar: &ProgressBar) -> Result<String, Fault> {
    let subjects: Vec<Subject> = COLUMNS
        .par_iter()
        .map(|column| {
            let subject = Subject::new(column);
            bar.inc(1);
            subject
        })
        .collect::<Result<_, _>>()?;
    let jobs: Vec<(usize, usize)> = (0..REQUIREMENTS.len()).flat_map(|r| (0..COLUMNS.len()).map(move |c| (r, c))).collect();
    let answers: Vec<Answer> = jobs
        .par_iter()
        .map(|&(r, c)| {
            let answer = (REQUIREMENTS[r].ask)(&subjects[c]);
            bar.inc(1);
            answer
        })
        .collect::<Result<_, _>>()?;
    let rows: Vec<Vec<String>> = REQUIREMENTS
        .iter()
        .enumerate()
        .map(|(r, requirement)| {
            let cells = jobs.iter().zip(&answers).filter(|((row, _), _)| *row == r);
            let cells = cells.map(|(_, a)| format!("{}: {}", if a.met { "met" } else { "not met" }, a.evidence));
            [format!("{} {}", requirement.number, requirement.text), requirement.printed.to_owned()].into_iter().chain(cells).collect()
        })
        .collect();
    let head: Vec<&str> = ["requirement", "dissertation, of itself"].into_iter().chain(COLUMNS.iter().map(|c| c.name)).collect();
    Ok(table_of_words(&head, &rows))
}

fn scene(name: &str) -> Result<Scene, Fault> {
    named(name).ok_or_else(|| Fault::Said(format!("there is no scene `{name}`")))
}

fn rows(rows: u32) -> Result<Scene, Fault> {
    tower(&TowerOptions { rows, ..TowerOptions::default() }).map_err(|e| Fault::Said(e.to_string()))
}

fn removes(subject: &Subject) -> Result<Answer, Fault> {
    let outcome = subject.moves[0];
    answer(outcome.stands && outcome.off < 0.02, format!("3-3 is out, {} mm from the hand", mm(outcome.off)))
}

fn places(subject: &Subject) -> Result<Answer, Fault> {
    let outcome = subject.moves[1];
    answer(outcome.stands && outcome.off < 3e-3, format!("{} mm from its place", mm(outcome.off)))
}

/// A hand that goes twice as far moves a block in the air twice as far.
fn analogue(subject: &Subject) -> Result<Answer, Fault> {
    let carried = |way: f64| {
        let mut tower = subject.build(&scene("block")?)?;
        tower.rest(30);
        let lifted = tower.centre(0) + 0.1 * DVec3::Z;
        let hold = |tower: &mut dyn Tower, target| (0..60).for_each(|_| tower.frame(Some(&Grasp { block: 0, target, carried: true })));
        hold(tower.as_mut(), lifted);
        let start = tower.centre(0);
        hold(tower.as_mut(), lifted + way * DVec3::X);
        Ok::<f64, Fault>((tower.centre(0) - start).x)
    };
    let (one, two) = (carried(0.01)?, carried(0.02)?);
    answer((two / one - 2.0).abs() < 0.05 && one > 5e-3, format!("{} mm for 10, {} mm for 20", mm(one), mm(two)))
}

/// Every block of a tower is under the middle of a pixel of some picture, as the camera goes round.
fn all_sides(subject: &Subject) -> Result<Answer, Fault> {
    let tower = subject.build(&rows(6)?)?;
    let mut seen = vec![false; tower.len()];
    for turn in 0..8 {
        let azimuth = f64::from(turn) * std::f64::consts::FRAC_PI_4 + 0.2;
        let camera = Camera { target: DVec3::new(0.0, 0.0, 0.054), distance: 0.6, azimuth, elevation: 0.2, half_height: 0.2 };
        for pixel in 0..64 * 64 {
            let at = |n: u32| f64::from(n) / 32.0 - 1.0;
            let ray = camera.ray(at(pixel % 64), at(pixel / 64));
            let nearest = (0..tower.len()).filter_map(|b| meets(&tower.corners(b), ray.origin, ray.direction).map(|t| (t, b)));
            if let Some((_, block)) = nearest.min_by(|a, b| a.0.total_cmp(&b.0)) {
                seen[block] = true;
            }
        }
    }
    let count = seen.iter().filter(|s| **s).count();
    answer(count == seen.len(), format!("{count} of {} blocks seen from eight sides", seen.len()))
}

/// Where a ray enters a block, in lengths of its direction.
fn meets(corners: &[DVec3; 8], origin: DVec3, direction: DVec3) -> Option<f64> {
    let (centre, half, axes) = frame(corners);
    let (mut enter, mut leave) = (0.0f64, f64::INFINITY);
    for (axis, half) in axes.into_iter().zip(half) {
        let (from, speed) = ((origin - centre).dot(axis), direction.dot(axis));
        let (a, b) = ((-half - from) / speed, (half - from) / speed);
        (enter, leave) = (enter.max(a.min(b)), leave.min(a.max(b)));
    }
    (enter < leave).then_some(enter)
}

/// Centre, half lengths and axes of a block.
fn frame(corners: &[DVec3; 8]) -> (DVec3, [f64; 3], [DVec3; 3]) {
    let sides = [0, 1, 2].map(|bit| (0..8).map(|c| if c >> bit & 1 == 1 { corners[c] } else { -corners[c] }).sum::<DVec3>() / 8.0);
    (corners.iter().sum::<DVec3>() / 8.0, sides.map(DVec3::length), sides.map(DVec3::normalize_or_zero))
}

/// How a block falls that a hand has let go.
fn gravity(subject: &Subject) -> Result<Answer, Fault> {
    let mut tower = subject.build(&scene("block")?)?;
    tower.rest(30);
    let target = tower.centre(0) + 0.3 * DVec3::Z;
    for _ in 0..120 {
        tower.frame(Some(&Grasp { block: 0, target, carried: true }));
    }
    // The second difference of the height over a tenth of a second.
    let span = 6;
    let mut heights = Vec::new();
    for _ in 0..3 {
        heights.push(tower.centre(0).z);
        tower.rest(span);
    }
    let time = f64::from(span) / FRAMES;
    let g = -(heights[0] - 2.0 * heights[1] + heights[2]) / (time * time);
    answer((g / 9.81 - 1.0).abs() < 0.02, format!("a block falls with {g:.2} m/s²"))
}

/// A block that slides comes to rest after v² / (2 mu g), and one pushed below mu N does not creep.
fn friction(subject: &Subject) -> Result<Answer, Fault> {
    let mut tower = subject.build(&scene("block")?)?;
    tower.rest(60);
    let start = tower.centre(0).x;
    let speed = 0.4;
    tower.throw(0, speed * DVec3::X);
    tower.rest(60);
    let (slid, expected) = (tower.centre(0).x - start, speed * speed / (2.0 * 0.4 * 9.81));
    let mut six = subject.build(&rows(6)?)?;
    six.rest(120);
    let before = six.centres();
    six.rest(120);
    let crept = six.centres().iter().zip(&before).map(|(now, was)| now.distance(*was)).fold(0.0, f64::max);
    let met = (slid / expected - 1.0).abs() < 0.15 && crept < 5e-5;
    answer(met, format!("slides {} mm for {}; six rows creep by {} mm in 2 s", mm(slid), mm(expected), mm(crept)))
}

fn statics_are(subject: &Subject, names: &[&str], stable: bool) -> Result<Answer, Fault> {
    let mut wrong = Vec::new();
    for name in names {
        if statics::stands(subject.column, name, |_| {})?.0 != stable {
            wrong.push(*name);
        }
    }
    let right = names.len() - wrong.len();
    let but = if wrong.is_empty() { String::new() } else { format!(", not {}", wrong.join(", ")) };
    answer(wrong.is_empty(), format!("{right} of {} towers{but}", names.len()))
}

fn stays(subject: &Subject) -> Result<Answer, Fault> {
    statics_are(subject, &["test-1", "test-5", "test-6", "test-2-out"], true)
}

fn collapses(subject: &Subject) -> Result<Answer, Fault> {
    statics_are(subject, &["test-3", "test-4", "test-2-in"], false)
}

fn removal_disturbs(subject: &Subject) -> Result<Answer, Fault> {
    let outcome = subject.moves[0];
    answer(outcome.stands && outcome.furthest < 1e-3, format!("taking loose 3-3 moves the others by {} mm at most", mm(outcome.furthest)))
}

fn placing_disturbs(subject: &Subject) -> Result<Answer, Fault> {
    let outcome = subject.moves[1];
    answer(
        outcome.stands && outcome.furthest < 1e-3,
        format!("laying a block on top moves the others by {} mm at most", mm(outcome.furthest)),
    )
}

/// A block thrown down at another: by 17 cm a frame, nine times its height.
fn no_passing(subject: &Subject) -> Result<Answer, Fault> {
    let mut two = scene("column")?;
    two.blocks.truncate(2);
    two.blocks[1].pos[2] += 0.2;
    let mut tower = subject.build(&two)?;
    tower.throw(1, -10.0 * DVec3::Z);
    let mut least = f64::INFINITY;
    for _ in 0..60 {
        tower.frame(None);
        let apart = tower.centre(1) - tower.centre(0);
        if apart.x.abs() < 0.04 && apart.y.abs() < 0.013 {
            least = least.min(apart.z);
        }
    }
    answer(least > 0.0, format!("thrown at another with 10 m/s its centre stays {} mm above", mm(least)))
}

/// How deep a block is in another at most, by corners and the middles of edges, m.
fn deepest(tower: &dyn Tower) -> f64 {
    let corners: Vec<[DVec3; 8]> = (0..tower.len()).map(|b| tower.corners(b)).collect();
    let frames: Vec<_> = corners.iter().map(frame).collect();
    let mut deepest = 0.0f64;
    for (a, corners) in corners.iter().enumerate() {
        let middles = teeter_dissertation::jenga3d::block::EDGE_CORNERS.map(|[p, q]| 0.5 * (corners[p] + corners[q]));
        for point in corners.iter().chain(&middles) {
            for (b, (centre, half, axes)) in frames.iter().enumerate().filter(|(b, _)| *b != a) {
                let depths = [0, 1, 2].map(|n| half[n] - (*point - *centre).dot(axes[n]).abs());
                let depth = depths.into_iter().fold(f64::INFINITY, f64::min);
                deepest = deepest.max(if b == a { 0.0 } else { depth });
            }
        }
    }
    deepest
}

fn no_embedding(subject: &Subject) -> Result<Answer, Fault> {
    let mut full = subject.build(&rows(18)?)?;
    full.rest(60);
    let most = subject.embedded.max(deepest(full.as_ref()));
    answer(most < 2e-4, format!("{} mm at most, in six moves and in a full tower", mm(most)))
}

/// How far corners go from frame to frame in a tower at rest.
fn no_jitter(subject: &Subject) -> Result<Answer, Fault> {
    let mut tower = subject.build(&rows(6)?)?;
    tower.rest(180);
    let mut most = 0.0f64;
    for _ in 0..60 {
        let before: Vec<_> = (0..tower.len()).map(|b| tower.corners(b)).collect();
        tower.frame(None);
        for (b, corners) in before.iter().enumerate() {
            let moved = tower.corners(b).iter().zip(corners).map(|(now, was)| now.distance(*was)).fold(0.0, f64::max);
            most = most.max(moved);
        }
    }
    answer(most < 1e-6, format!("corners go {} µm a frame at most", (1e7 * most).round() / 10.0))
}

/// A hand that pulls a block hard to and fro through a tower, and rows that are let fall: all stays finite and above the floor.
fn no_crash(subject: &Subject) -> Result<Answer, Fault> {
    let mut tower = subject.build(&rows(6)?)?;
    tower.rest(15);
    for frame in 0..180 {
        let side = if frame / 20 % 2 == 0 { 0.3 } else { -0.3 };
        let target = DVec3::new(side, 0.5 * side, 0.1);
        tower.frame(Some(&Grasp { block: 7, target, carried: false }));
    }
    tower.rest(60);
    let sane = |c: &DVec3| c.is_finite() && c.length() < 10.0 && c.z > 0.0;
    let lost = tower.centres().iter().filter(|c| !sane(c)).count();
    answer(lost == 0, format!("{lost} blocks lost when a hand shakes a tower for 3 s"))
}

fn real_time(subject: &Subject) -> Result<Answer, Fault> {
    let rate = frame_rate::rate(subject.column, 18)?;
    answer(rate >= 12.0, format!("{rate:.0} a second with 18 rows, each a sixtieth of a second"))
}

/// A whole move needs a block and a place for the hand in each frame, which is what a mouse gives.
fn simple(subject: &Subject) -> Result<Answer, Fault> {
    let outcomes = &subject.moves[..2];
    answer(
        outcomes.iter().all(|o| o.stands),
        "a move is made with one pointer and one modifier; whether it is intuitive no program can tell".into(),
    )
}

#[cfg(test)]
mod tests {
    use std::sync::LazyLock;

    use super::*;

    /// Played once for all tests.
    static SUBJECTS: LazyLock<Vec<Subject>> =
        LazyLock::new(|| COLUMNS.iter().map(|column| Subject::new(column).expect("the moves are played")).collect());

    /// Which columns meet a requirement, and what each showed.
    fn met(number: &str) -> Vec<(bool, String)> {
        let requirement = REQUIREMENTS.iter().find(|r| r.number == number).expect("there is such a requirement");
        let answers = SUBJECTS.iter().map(|subject| (requirement.ask)(subject).expect("the experiment runs"));
        answers.map(|a| (a.met, a.evidence)).collect()
    }

    macro_rules! requirement {
        ($name:ident, $number:literal, $expected:expr) => {
            #[test]
            fn $name() {
                let answers = met($number);
                assert_eq!(answers.iter().map(|a| a.0).collect::<Vec<_>>(), $expected, "{answers:?}");
            }
        };
    }

    // Of the 2003 method, the same with its future work, and rigid blocks.
    requirement!(r_1_1_remove_a_block, "1.1", [true, true, true]);
    requirement!(r_1_2_place_a_block, "1.2", [true, true, true]);
    requirement!(r_1_3_analogue_input, "1.3", [true, true, true]);
    requirement!(r_1_4_all_sides_in_view, "1.4", [true, true, true]);
    requirement!(r_2_1_gravity, "2.1", [true, true, true]);
    requirement!(r_2_2_friction, "2.2", [false, true, true]);
    requirement!(r_2_3_stays_up, "2.3", [false, false, true]);
    requirement!(r_2_4_collapses, "2.4", [true, true, true]);
    requirement!(r_2_5_removal, "2.5", [false, false, true]);
    requirement!(r_2_6_placing, "2.6", [true, true, true]);
    requirement!(r_2_7_no_passing, "2.7", [true, true, true]);
    requirement!(r_2_8_no_embedding, "2.8", [true, true, true]);
    requirement!(r_2_9_no_jitter, "2.9", [false, true, true]);
    requirement!(r_3_1_no_crash, "3.1", [true, true, true]);
    /// Springs are measured as they are played: without the checks of a debugging build.
    #[test]
    fn r_3_2_real_time() {
        let answers = met("3.2");
        let springs = cfg!(debug_assertions) || answers[..2].iter().all(|a| a.0);
        assert!(springs && answers[2].0, "{answers:?}");
    }

    requirement!(r_3_3_simple, "3.3", [true, true, true]);
}
