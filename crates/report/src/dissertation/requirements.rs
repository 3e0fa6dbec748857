//! The requirements of section 3.6, each answered by an experiment.

use glam::DVec3;
use indicatif::ProgressBar;
use rayon::prelude::*;
use teeter_dissertation::jenga3d::pick::Camera;
use teeter_scene::{Scene, TowerOptions, named, tower};

use super::column::{COLUMNS, Column, FRAMES, Grasp, Tower};
use super::page::{mm, table_of_words};
use super::{moves, statics, work};
use crate::error::Error;

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
    pub fn new(column: &'static Column) -> Result<Self, Error> {
        let (mut outcomes, mut embedded) = (Vec::new(), 0.0f64);
        moves::play(column, &moves::acts()[..6], |tower, outcome| {
            embedded = embedded.max(deepest(tower));
            outcomes.push(outcome);
        })?;
        Ok(Self { column, moves: outcomes, embedded })
    }

    fn build(&self, scene: &Scene) -> Result<Box<dyn Tower>, Error> {
        (self.column.build)(scene)
    }
}

fn answer(met: bool, evidence: String) -> Result<Answer, Error> {
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
    pub ask: fn(&Subject) -> Result<Answer, Error>,
}

const fn requirement(
    number: &'static str,
    text: &'static str,
    printed: &'static str,
    ask: fn(&Subject) -> Result<Answer, Error>,
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
pub fn run(bar: &ProgressBar) -> Result<String, Error> {
    let subjects: Vec<Subject> = COLUMNS
        .par_iter()
        .map(|column| {
            let subject = Subject::new(column);
            bar.inc(1);
            subject
        })
        .collect::<Result<_, _>>()?;
    let jobs: Vec<(usize, usize)> =
        (0..REQUIREMENTS.len()).flat_map(|r| (0..COLUMNS.len()).map(move |c| (r, c))).collect();
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
            let cells = cells.map(|(_, a)| format!("{}: {}", if a.met { "met" } else { "<b>not met</b>" }, a.evidence));
            [format!("{} {}", requirement.number, requirement.text), requirement.printed.to_owned()]
                .into_iter()
                .chain(cells)
                .collect()
        })
        .collect();
    let head: Vec<&str> =
        ["requirement", "dissertation, of itself"].into_iter().chain(COLUMNS.iter().map(|c| c.name)).collect();
    Ok(table_of_words(&head, &rows))
}

fn scene(name: &str) -> Result<Scene, Error> {
    named(name).ok_or_else(|| Error::Said(format!("there is no scene `{name}`")))
}

fn rows(rows: u32) -> Result<Scene, Error> {
    tower(&TowerOptions { rows, ..TowerOptions::default() }).map_err(|e| Error::Said(e.to_string()))
}

fn removes(subject: &Subject) -> Result<Answer, Error> {
    let outcome = subject.moves[0];
    answer(outcome.stands && outcome.off < 0.02, format!("3-3 is out, {} mm from the hand", mm(outcome.off)))
}

fn places(subject: &Subject) -> Result<Answer, Error> {
    let outcome = subject.moves[1];
    answer(outcome.stands && outcome.off < 3e-3, format!("{} mm from its place", mm(outcome.off)))
}

/// A hand that goes twice as far moves a block in the air twice as far.
fn analogue(subject: &Subject) -> Result<Answer, Error> {
    let carried = |way: f64| {
        let mut tower = subject.build(&scene("block")?)?;
        tower.rest(30);
        let lifted = tower.centre(0) + 0.1 * DVec3::Z;
        let hold = |tower: &mut dyn Tower, target| {
            (0..60).for_each(|_| tower.frame(Some(&Grasp { block: 0, target, carried: true })))
        };
        hold(tower.as_mut(), lifted);
        let start = tower.centre(0);
        hold(tower.as_mut(), lifted + way * DVec3::X);
        Ok::<f64, Error>((tower.centre(0) - start).x)
    };
    let (one, two) = (carried(0.01)?, carried(0.02)?);
    answer((two / one - 2.0).abs() < 0.05 && one > 5e-3, format!("{} mm for 10, {} mm for 20", mm(one), mm(two)))
}

/// Every block of a tower is under the middle of a pixel of some picture, as the camera goes round.
fn all_sides(subject: &Subject) -> Result<Answer, Error> {
    let tower = subject.build(&rows(6)?)?;
    let mut seen = vec![false; tower.len()];
    for turn in 0..8 {
        let azimuth = f64::from(turn) * std::f64::consts::FRAC_PI_4 + 0.2;
        let camera =
            Camera { target: DVec3::new(0.0, 0.0, 0.054), distance: 0.6, azimuth, elevation: 0.2, half_height: 0.2 };
        for pixel in 0..64 * 64 {
            let at = |n: u32| f64::from(n) / 32.0 - 1.0;
            let ray = camera.ray(at(pixel % 64), at(pixel / 64));
            let nearest =
                (0..tower.len()).filter_map(|b| meets(&tower.corners(b), ray.origin, ray.direction).map(|t| (t, b)));
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
    let sides = [0, 1, 2]
        .map(|bit| (0..8).map(|c| if c >> bit & 1 == 1 { corners[c] } else { -corners[c] }).sum::<DVec3>() / 8.0);
    (corners.iter().sum::<DVec3>() / 8.0, sides.map(DVec3::length), sides.map(DVec3::normalize_or_zero))
}

/// How a block falls that a hand has let go.
fn gravity(subject: &Subject) -> Result<Answer, Error> {
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
fn friction(subject: &Subject) -> Result<Answer, Error> {
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

fn statics_are(subject: &Subject, names: &[&str], stable: bool) -> Result<Answer, Error> {
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

fn stays(subject: &Subject) -> Result<Answer, Error> {
    statics_are(subject, &["test-1", "test-5", "test-6", "test-2-out"], true)
}

fn collapses(subject: &Subject) -> Result<Answer, Error> {
    statics_are(subject, &["test-3", "test-4", "test-2-in"], false)
}

fn removal_disturbs(subject: &Subject) -> Result<Answer, Error> {
    let outcome = subject.moves[0];
    answer(
        outcome.stands && outcome.furthest < 1e-3,
        format!("taking loose 3-3 moves the others by {} mm at most", mm(outcome.furthest)),
    )
}

fn placing_disturbs(subject: &Subject) -> Result<Answer, Error> {
    let outcome = subject.moves[1];
    answer(
        outcome.stands && outcome.furthest < 1e-3,
        format!("laying a block on top moves the others by {} mm at most", mm(outcome.furthest)),
    )
}

/// How a block is thrown at another that stands on the floor: from where, m from its centre, the way it flies, and how far it is turned about the
/// vertical, rad.
const THROWS: [(DVec3, DVec3, f64); 5] = [
    // face on face, along it and across
    (DVec3::new(0.0, 0.0, 0.2), DVec3::NEG_Z, 0.0),
    (DVec3::new(0.006, 0.0, 0.2), DVec3::NEG_Z, std::f64::consts::FRAC_PI_2),
    // end on end, side on side, and an edge on a side
    (DVec3::new(-0.3, 0.0, 0.0), DVec3::X, 0.0),
    (DVec3::new(0.0, -0.2, 0.0), DVec3::Y, 0.0),
    (DVec3::new(0.0, -0.2, 0.0), DVec3::Y, std::f64::consts::FRAC_PI_4),
];
/// How fast, m/s: by 3 and 17 cm a frame, so that ends of frames alone could miss all of it.
const SPEEDS: [f64; 2] = [2.0, 10.0];

/// Blocks thrown at each other keep their order along the throw for as long as one is in the other's way, and a hand that drives a block into the
/// side of a tower, which moves by half of its thickness a frame, pushes it and does not go in.
fn no_passing(subject: &Subject) -> Result<Answer, Error> {
    let mut through = 0;
    for ((from, way, yaw), speed) in THROWS.into_iter().flat_map(|throw| SPEEDS.map(|speed| (throw, speed))) {
        let mut two = scene("column")?;
        two.blocks.truncate(2);
        two.blocks[1].pos = (DVec3::from(two.blocks[0].pos) + from).to_array();
        two.blocks[1].yaw = yaw;
        let mut tower = subject.build(&two)?;
        tower.throw(1, speed * way);
        let passed = (0..60).any(|_| {
            tower.frame(None);
            let apart = tower.centre(1) - tower.centre(0);
            // A block is at least 9 mm from its centre to its side: nearer the line than that, neither has made way.
            apart.dot(way) > 0.0 && (apart - apart.dot(way) * way).length() < 9e-3
        });
        through += u32::from(passed);
    }
    let mut six = rows(6)?;
    let block = six.blocks.len();
    six.blocks.push(teeter_scene::Block {
        id: block as u32,
        pos: [0.0, -0.12, 0.5 * six.blocks[0].size[2]],
        yaw: 0.0,
        ..six.blocks[0].clone()
    });
    let mut tower = subject.build(&six)?;
    tower.rest(30);
    let mut deepest_of_all = 0.0f64;
    let from = DVec3::new(0.0, -0.12, 0.063);
    for frame in 0..90 {
        // up in half a second, and on through where the tower is
        let on = 0.009 * f64::from(u32::saturating_sub(frame, 30));
        tower.frame(Some(&Grasp { block: block as u32, target: from + on.min(0.3) * DVec3::Y, carried: true }));
        deepest_of_all = deepest_of_all.max(deepest(tower.as_ref()));
    }
    let throws = THROWS.len() * SPEEDS.len();
    answer(
        through == 0 && deepest_of_all < 4.5e-3,
        format!(
            "of {throws} throws at up to 10 m/s {through} go through; a hand drives a block {} mm into others of a tower",
            mm(deepest_of_all)
        ),
    )
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

fn no_embedding(subject: &Subject) -> Result<Answer, Error> {
    let mut full = subject.build(&rows(18)?)?;
    full.rest(60);
    let most = subject.embedded.max(deepest(full.as_ref()));
    answer(most < 2e-4, format!("{} mm at most, in six moves and in a full tower", mm(most)))
}

/// How far corners go from frame to frame in a tower at rest.
fn no_jitter(subject: &Subject) -> Result<Answer, Error> {
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
fn no_crash(subject: &Subject) -> Result<Answer, Error> {
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

/// By the work of the dearest frame while a tower settles: Figure 6.23 is what a clock says.
fn real_time(subject: &Subject) -> Result<Answer, Error> {
    let mut tower = subject.build(&rows(18)?)?;
    let dearest = (0..30).fold(0.0, |most: f64, _| {
        tower.frame(None);
        most.max(tower.work())
    });
    let rate = work::CORE / dearest;
    answer(
        rate >= 12.0,
        format!(
            "18 rows take {:.0} million operations a frame at most: {rate:.0} frames a second of a core that does one a cycle at 2 GHz",
            1e-6 * dearest
        ),
    )
}

/// A whole move needs a block and a place for the hand in each frame, which is what a mouse gives.
fn simple(subject: &Subject) -> Result<Answer, Error> {
    let outcomes = &subject.moves[..2];
    answer(
        outcomes.iter().all(|o| o.stands),
        "a move is made with one pointer and one modifier; whether it is intuitive no program can tell".into(),
    )
}

#[cfg(test)]
mod tests {
    use std::sync::LazyLock;

    use rayon::prelude::*;

    use super::*;

    /// Played once for all tests, and on all cores: the tests wait for it.
    static SUBJECTS: LazyLock<Vec<Subject>> = LazyLock::new(|| {
        COLUMNS.par_iter().map(|column| Subject::new(column).expect("the moves are played")).collect()
    });

    /// The columns that do not meet a requirement are these, and all others do.
    fn all_meet_but(number: &str, columns: &[&str]) {
        let requirement = REQUIREMENTS.iter().find(|r| r.number == number).expect("there is such a requirement");
        let answers: Vec<Answer> =
            SUBJECTS.iter().map(|subject| (requirement.ask)(subject).expect("the experiment runs")).collect();
        let fail: Vec<&str> = COLUMNS.iter().zip(&answers).filter(|(_, a)| !a.met).map(|(c, _)| c.name).collect();
        assert_eq!(fail, columns, "{answers:?}");
    }

    macro_rules! requirement {
        ($name:ident, $number:literal, $columns:expr) => {
            #[test]
            fn $name() {
                all_meet_but($number, &$columns);
            }
        };
    }

    /// A block that nothing stops.
    struct Ghost {
        scene: Scene,
        velocities: Vec<DVec3>,
    }

    impl Tower for Ghost {
        fn frame(&mut self, hand: Option<&Grasp>) {
            for (block, velocity) in self.scene.blocks.iter_mut().zip(&self.velocities) {
                block.pos = (DVec3::from(block.pos) + *velocity / FRAMES).to_array();
            }
            if let Some(grasp) = hand {
                self.scene.blocks[grasp.block as usize].pos = grasp.target.to_array();
            }
        }

        fn len(&self) -> usize {
            self.scene.blocks.len()
        }

        fn corners(&self, block: usize) -> [DVec3; 8] {
            let block = &self.scene.blocks[block];
            let side = |c: usize, bit: usize| if c >> bit & 1 == 1 { 0.5 } else { -0.5 } * block.size[bit];
            let turn = glam::DQuat::from_rotation_z(block.yaw);
            std::array::from_fn(|c| DVec3::from(block.pos) + turn * DVec3::new(side(c, 0), side(c, 1), side(c, 2)))
        }

        fn rests(&self, _: usize) -> bool {
            false
        }

        fn work(&self) -> f64 {
            0.0
        }

        fn throw(&mut self, block: usize, velocity: DVec3) {
            self.velocities[block] = velocity;
        }
    }

    #[test]
    fn what_passes_through_is_seen() {
        static GHOST: Column = Column {
            name: "ghost",
            colour: "",
            build: |scene| {
                Ok(Box::new(Ghost { scene: scene.clone(), velocities: vec![DVec3::ZERO; scene.blocks.len()] }))
            },
        };
        let subject = Subject { column: &GHOST, moves: Vec::new(), embedded: 0.0 };
        let answer = no_passing(&subject).expect("the experiment runs");
        assert!(!answer.met);
        // The hand goes to the middle of a block, half its height from its faces.
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
