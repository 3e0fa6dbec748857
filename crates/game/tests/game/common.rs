//! Towers and commands for tests of play.

use glam::DVec3;
use teeter_game::{Command, Event, Game, GripMode, Update};
use teeter_physics::{BodyId, Params, StepReport, World};
use teeter_scene::{Scene, TowerOptions};
use teeter_study::xray;

pub fn tower(rows: u32, seed: u64) -> Scene {
    teeter_scene::tower(&TowerOptions { rows, seed, ..TowerOptions::default() }).expect("the options are valid")
}

/// A game that has settled for a second.
pub fn settled(scene: &Scene) -> Game {
    let mut game = Game::new(World::new(scene, Params::default()).expect("the scene is valid"));
    idle(&mut game, 60);
    game
}

pub fn idle(game: &mut Game, frames: u32) -> Option<Update<StepReport>> {
    (0..frames).map(|_| game.step(&Command::Idle)).last()
}

/// The first block, from the second row on and below the top row, that is loose or not, by the
/// X-ray.
pub fn block(game: &Game, loose: bool) -> BodyId {
    let loads = xray(game.world(), 0.4);
    let candidates = 3..loads.len() - 3;
    candidates.into_iter().find(|&i| loads[i].is_loose() == loose).map(|i| BodyId(i as u32)).expect("there is one")
}

/// Grasps a block by its end along +x of its own frame.
pub fn grasp(game: &Game, body: BodyId, grip: GripMode) -> Command {
    let normal = game.blocks().orientation(body) * DVec3::X;
    Command::Grasp { body, anchor: DVec3::X * (0.5 * game.blocks().size(body).x), normal, grip }
}

/// Moves the goal without a slot.
pub fn displace(displacement: DVec3) -> Command {
    Command::Move { displacement, slot: None, toward_viewer: None }
}

/// Largest displacement of any block but one since `before`, m.
pub fn others(game: &Game, before: &[DVec3], body: BodyId) -> f64 {
    let moved = game.blocks().bodies().zip(before).filter(|(other, _)| *other != body);
    moved.map(|(other, was)| game.blocks().position(other).distance(*was)).fold(0.0, f64::max)
}

pub fn refusal(update: &Update<StepReport>) -> Option<&str> {
    update.events.iter().find_map(|event| match event {
        Event::Refused { reason } => Some(reason.as_str()),
        _ => None,
    })
}
