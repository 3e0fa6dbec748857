//! Scripted player: takes a block out of the tower and puts it back on top.

use glam::DVec3;
use teeter_physics::BodyId;

use crate::command::Command;
use crate::game::Game;
use crate::hand::grip::{GripMode, HoldGrip};
use crate::orientation::slide_axis;
use crate::simulator::Simulator;
use crate::tower_map::CellId;

/// Travel after which a block that has not come out of the tower is let go, m, over its length.
const MAX_TRAVEL: f64 = 1.5;

/// Stage of a script.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Stage {
    Grasp,
    /// Displacement of the goal so far, m.
    Pull(f64),
    Place,
    Wait,
    Done,
}

/// Commands, one a frame, of a player who draws a block out by its end, along its own length, and
/// sets it down in a slot.
///
/// ```
/// use teeter_game::{Command, Game, TakeAndPlace};
/// use teeter_physics::{BodyId, Params, World};
///
/// let scene = teeter_scene::named("tower").unwrap();
/// let game = Game::new(World::new(&scene, Params::default())?);
/// let mut script = TakeAndPlace::new(BodyId(4), glam::DVec3::Y, 0.1, None);
/// assert!(matches!(script.next(&game), Some(Command::Grasp { body: BodyId(4), .. })));
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct TakeAndPlace {
    body: BodyId,
    toward: DVec3,
    speed: f64,
    slot: Option<CellId>,
    stage: Stage,
}

impl TakeAndPlace {
    /// Draws `body` out at `speed` (m/s) by the end that points to `toward` (a direction of the
    /// world), and sets it down in `slot`, or in the nearest one.
    pub fn new(body: BodyId, toward: DVec3, speed: f64, slot: Option<CellId>) -> Self {
        Self { body, toward, speed, slot, stage: Stage::Grasp }
    }

    /// Command for the next frame; none once the block has been let go.
    pub fn next<S: Simulator>(&mut self, game: &Game<S>) -> Option<Command> {
        let blocks = game.blocks();
        let axis = |body| {
            let along = slide_axis(blocks.orientation(body));
            if along.dot(self.toward) < 0.0 { -along } else { along }
        };
        let grip = game.hold_grip(self.body);
        let (command, stage) = match self.stage {
            Stage::Grasp => {
                let local = blocks.orientation(self.body).conjugate() * axis(self.body);
                let anchor = DVec3::X * (0.5 * blocks.size(self.body).x * local.x.signum());
                let normal = axis(self.body);
                (Command::Grasp { body: self.body, anchor, normal, grip: GripMode::Auto }, Stage::Pull(0.0))
            }
            Stage::Pull(travel) => match grip {
                None => return self.stop(None),
                Some(HoldGrip::Carry) => (Command::Place { body: None, slot: self.slot }, Stage::Place),
                Some(_) if travel > MAX_TRAVEL * blocks.size(self.body).x => return self.stop(Some(Command::Release)),
                Some(_) => {
                    let step = self.speed * game.world().frame();
                    let displacement = axis(self.body) * step;
                    (Command::Move { displacement, slot: None, toward_viewer: None }, Stage::Pull(travel + step))
                }
            },
            // A slot is offered from the first frame in which the block is carried; without one the
            // block is let go.
            Stage::Place if grip.is_some() && !game.is_placing() => return self.stop(Some(Command::Release)),
            Stage::Place | Stage::Wait if grip.is_some() => (Command::Idle, Stage::Wait),
            Stage::Place | Stage::Wait | Stage::Done => return self.stop(None),
        };
        self.stage = stage;
        Some(command)
    }

    fn stop(&mut self, last: Option<Command>) -> Option<Command> {
        self.stage = Stage::Done;
        last
    }
}
