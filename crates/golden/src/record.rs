//! Recording of inputs: a sweep of two rows, and a hand that moves a loose block to the top.
//!
//! The path of the hand is computed from a world once. Playback reads the recorded targets.

use std::path::Path;

use glam::{DQuat, DVec3};
use teeter_physics::{BodyId, Drive, Grip, Hand, Input, Params, World};
use teeter_study::HandPath;

use crate::error::GoldenError;
use crate::files::write;

/// Number of steps in which the tower settles first.
const SETTLE_STEPS: usize = 60;

/// Records all inputs.
///
/// # Errors
/// When a file cannot be written, or the tower has no loose block.
pub fn record(dir: &Path) -> Result<(), GoldenError> {
    write(dir, "sweep.jsonl", &lines(&sweep()))?;
    write(dir, "pull.jsonl", &lines(&pull()?))
}

/// Formats one input a line; an idle input is an empty line.
fn lines(inputs: &[Input]) -> String {
    let line = |input: &Input| match input {
        idle if *idle == Input::default() => "\n".to_owned(),
        input => serde_json::to_string(input).expect("an input serialises") + "\n",
    };
    inputs.iter().map(line).collect()
}

/// Returns inputs that drive two rows out of the tower.
fn sweep() -> Vec<Input> {
    let drive = |body| Drive::new(BodyId(body), DVec3::new(2.0, 0.5, 0.0));
    let mut inputs = vec![Input::default(); SETTLE_STEPS];
    inputs.resize(SETTLE_STEPS + 12, Input::drives((6..12).map(drive).collect()));
    inputs
}

/// Returns inputs of a hand that pulls a loose block out by its end and puts it on the tower.
fn pull() -> Result<Vec<Input>, GoldenError> {
    let scene = teeter_scene::named("tower").expect("the list has it");
    let mut world = World::new(&scene, Params::default())?;
    let mut inputs = vec![Input::default(); SETTLE_STEPS];
    inputs.iter().for_each(|input| drop(world.step(input)));

    let above = |body| world.contacts(body).iter().filter(|c| c.normal.z < -0.5).map(|c| c.force).sum::<f64>();
    let below_top = world.len() as u32 - 3;
    let body = (9..below_top).map(BodyId).find(|&body| above(body) < 1e-3).ok_or(GoldenError::NoLooseBlock)?;
    let (position, q) = (world.pose(body).position, rounded_rotation(world.pose(body).orientation));
    let top = world.bodies().map(|i| world.pose(i).position.z + 0.5 * world.size(i).z).fold(0.0, f64::max);
    let height = world.size(body).z;
    let anchor = rounded(DVec3::new(0.5 * world.size(body).x, 0.0, 0.0));

    let start = position + q * anchor;
    let out = start + q * DVec3::X * 0.11;
    let clear = top + 0.5 * height + 0.01;
    let over = DVec3::new(0.0, 0.0, clear) + q * anchor;
    let laid = over - DVec3::Z * 0.0105;
    let path = HandPath::new(Hand::slide(body, anchor, start, q), world.params().frame)
        .line(out, 0.08)
        .with_grip(Grip::Carry)
        .line(out.with_z(over.z), 0.4)
        .line(over, 0.3)
        .line(laid, 0.04);
    inputs.extend(path.into_iter().map(|hand| Input::hand(Hand { target: rounded(hand.target), ..hand })));
    Ok(inputs)
}

/// Rounds to the micrometre, which keeps the file short.
fn rounded(v: DVec3) -> DVec3 {
    (v * 1e6).round() / 1e6
}

/// Rounds the components of a rotation to six digits.
fn rounded_rotation(q: DQuat) -> DQuat {
    DQuat::from_array(q.to_array().map(|x| (x * 1e6).round() / 1e6))
}
