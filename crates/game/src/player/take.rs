//! Hand of a player who carries out the plan of a move, one command a frame.

use glam::{DQuat, DVec3};
use teeter_physics::BodyId;

use crate::command::Command;
use crate::game::Game;
use crate::hand::grip::{GripMode, HoldGrip};
use crate::hand::hold::Hold;
use crate::orientation::{angle_between, nearest_alike, rotation_about_z, slide_axis};
use crate::player::noise::{Errors, HandNoise};
use crate::player::percept::{Percept, Senses};
use crate::player::stage::{Extraction, Landing, MoveEnd, MovePlan, Stage};
use crate::simulator::Simulator;
use crate::tower_map::Slot;

/// Speeds of the hand, m/s: along the tower, through the air, and down to the slot.
const DRAW: f64 = 0.06;
const CARRY: f64 = 0.25;
const LOWER: f64 = 0.06;
const TOUCH_DOWN: f64 = 0.012;
/// Height above the slot below which the hand is slow, m.
const NEAR: f64 = 0.008;
/// Share of a face within which a finger touches it, from its middle.
const ON_FACE: f64 = 0.35;
/// Time without motion after which a block is stuck, s.
const STUCK: f64 = 0.4;
/// Travel of a push that brings a block half through, and of the goal after which a block that does
/// not come out is given up, over its length.
const THROUGH: f64 = 0.4;
const GIVE_UP: f64 = 1.6;
/// Distance from where a block was within which it is put back, m; speed at which the hand nudges
/// it on where its goal alone did not bring it there, m/s; frames after which the hand lets go of
/// it wherever it is.
const HOME: f64 = 0.001;
const NUDGE: f64 = 0.004;
const RETURN: u32 = 300;
/// Displacement by a poke from which a block is loose, m.
const LOOSE: f64 = 0.002;
/// Distance by which a block is drawn clear of the tower before it rises, m.
const CLEAR: f64 = 0.025;
/// Offset (m) and angle (rad) within which a block is above its slot.
const ABOVE: f64 = 0.0015;
const ALIGNED: f64 = 0.02;
/// Distance that a hand keeps from a neighbour, and that it adds after it came down on one, m.
const BESIDE: f64 = 0.0025;
/// Upward force from which a touch is felt, N, and share of the height by which a block that
/// touches is too high to stand in its slot.
const FELT: f64 = 0.1;
const TOO_HIGH: f64 = 0.25;
/// Number of times that a block may come down on a neighbour.
const MAX_TRIES: u32 = 5;
/// Frames until the hand opens after a block stands, and after which a stage is given up.
const STANDS: u32 = 10;
const PATIENCE: u32 = 480;

/// Hand of a player: commands, one a frame, that carry out a plan with the errors of a person.
///
/// All of it follows from the plan, the seed and the game.
///
/// ```
/// use teeter_game::{Command, Game, HandNoise, MovePlan, PlayerHand};
/// use teeter_physics::{BodyId, Params, World};
///
/// let scene = teeter_scene::named("tower").unwrap();
/// let game = Game::new(World::new(&scene, Params::default())?);
/// let plan = MovePlan::pull(BodyId(4), glam::DVec3::Y);
/// let mut hand = PlayerHand::new(&game, plan, HandNoise::default(), 7);
/// assert!(matches!(hand.next(&game), Some(Command::Grasp { body: BodyId(4), .. })));
/// assert_eq!(hand.end(), None);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct PlayerHand {
    plan: MovePlan,
    errors: Errors,
    senses: Senses,
    stage: Stage,
    /// Frames in the stage.
    frames: u32,
    /// Centre of the block where it belongs until it is out, m.
    origin: DVec3,
    /// Centre of the block when the hand took hold of it last, m.
    grasped: DVec3,
    /// Angle by which the hand draws askew, rad.
    askew: f64,
}

impl PlayerHand {
    /// A hand that begins a move.
    pub fn new<S: Simulator>(game: &Game<S>, plan: MovePlan, noise: HandNoise, seed: u64) -> Self {
        let mut errors = Errors::new(noise, seed);
        let stage = match plan.extraction {
            Extraction::Pull => Stage::Grasp,
            Extraction::PushThrough => Stage::Finger,
            Extraction::Test => Stage::Touch,
        };
        let origin = game.blocks().positions().get(plan.body.index()).copied().unwrap_or_default();
        let (senses, askew) = (Senses::new(noise.lag, game.world().frame()), errors.angle());
        Self { plan, errors, senses, stage, frames: 0, origin, grasped: origin, askew }
    }

    /// A hand that moves a block back to where it belongs, by the end that stands out most.
    pub fn putting_back<S: Simulator>(game: &Game<S>, body: BodyId, home: DVec3, noise: HandNoise, seed: u64) -> Self {
        let toward = game.blocks().positions().get(body.index()).map_or(DVec3::X, |position| *position - home);
        let hand = Self::new(game, MovePlan::pull(body, toward), noise, seed);
        Self { stage: Stage::Return, origin: home, ..hand }
    }

    /// End of the move; none before.
    pub fn end(&self) -> Option<MoveEnd> {
        if let Stage::Done(end) = self.stage { Some(end) } else { None }
    }

    /// Command for the next frame; none after the end of the move, and where there is no such
    /// block.
    pub fn next<S: Simulator>(&mut self, game: &Game<S>) -> Option<Command> {
        if self.plan.body.index() >= game.blocks().len() {
            self.stage = Stage::Done(MoveEnd::Dropped);
        }
        if self.end().is_some() {
            return None;
        }
        let noticed = self.senses.notice(Percept::now(game, self.plan.body));
        let shake = self.errors.shake(game.world().frame());
        let (command, next) = self.advance(game, &noticed, shake);
        self.frames =
            if std::mem::discriminant(&next) == std::mem::discriminant(&self.stage) { self.frames + 1 } else { 0 };
        let is_late = self.frames > PATIENCE && !matches!(next, Stage::LetGo(_) | Stage::Done(_));
        self.stage = if is_late { Stage::LetGo(MoveEnd::Dropped) } else { next };
        Some(command.rounded())
    }

    fn advance<S: Simulator>(&mut self, game: &Game<S>, noticed: &Percept, shake: DVec3) -> (Command, Stage) {
        let hold = game.controller.hold().filter(|hold| hold.body == self.plan.body);
        match (self.stage, hold) {
            (Stage::Touch, _) => (self.grasp(game, -1.0, GripMode::Auto), Stage::Poked),
            (Stage::Poked, _) => self.poked(game, hold.is_some(), noticed),
            (Stage::Finger, _) => (self.grasp(game, -1.0, GripMode::Push), Stage::Push(0.0)),
            (Stage::Grasp, _) => (self.grasp(game, 1.0, GripMode::Auto), Stage::Pull(0.0)),
            (Stage::Return, _) => (self.grasp(game, 1.0, GripMode::Auto), Stage::Back),
            (Stage::LetGo(end), Some(_)) => (Command::Release, Stage::Done(end)),
            (Stage::LetGo(end) | Stage::Done(end), _) => (Command::Idle, Stage::Done(end)),
            // The hand is empty although it should hold the block: the grasp was refused, or it was
            // made to let go.
            (_, None) => (Command::Idle, Stage::Done(MoveEnd::Dropped)),
            (Stage::Push(travel), Some(_)) => self.push(game, noticed, travel, shake),
            (Stage::Pull(travel), Some(_)) => self.pull(game, noticed, travel, shake),
            (Stage::Back, Some(hold)) => self.back(game, noticed, hold, shake),
            (Stage::Clear(travel), Some(_)) => self.clear(game, travel, shake),
            (Stage::Rise(landing), Some(hold)) => Self::rise(game, noticed, hold, landing, shake),
            (Stage::Turn(landing), Some(hold)) => {
                let current = hold.orientation.unwrap_or(DQuat::IDENTITY);
                (Command::Turn { rotation: landing.orientation * current.conjugate() }, Stage::Hold(landing))
            }
            (Stage::Hold(landing), Some(_)) => {
                let grip = Some(GripMode::Carry);
                (Command::SetHand { max_force: None, careful: None, can_turn: None, grip }, Stage::Cross(landing))
            }
            (Stage::Cross(landing), Some(hold)) => Self::cross(game, noticed, hold, landing, shake),
            (Stage::Lower(landing), Some(hold)) => Self::lower(game, noticed, hold, landing, shake),
            (Stage::Stand(_, frames), Some(_)) if frames >= STANDS => (Command::Idle, Stage::LetGo(MoveEnd::Placed)),
            (Stage::Stand(landing, frames), Some(_)) => (displace(shake), Stage::Stand(landing, frames + 1)),
        }
    }

    /// Takes hold of the block by the end to which it leaves, `side` 1, or the other one, -1.
    fn grasp<S: Simulator>(&mut self, game: &Game<S>, side: f64, grip: GripMode) -> Command {
        let body = self.plan.body;
        let (size, orientation) = (game.blocks().size(body), game.blocks().orientation(body));
        let normal = self.outward(game) * side;
        let local = orientation.conjugate() * normal;
        let error = self.errors.position();
        self.grasped = game.blocks().position(body);
        let on_face = |error: f64, edge: f64| error.clamp(-ON_FACE * edge, ON_FACE * edge);
        let anchor = DVec3::new(0.5 * size.x * local.x.signum(), on_face(error.y, size.y), on_face(error.z, size.z));
        Command::Grasp { body, anchor, normal, grip }
    }

    /// Direction along the block in which it leaves the tower.
    fn outward<S: Simulator>(&self, game: &Game<S>) -> DVec3 {
        let along = slide_axis(game.blocks().orientation(self.plan.body));
        if along.dot(self.plan.toward) < 0.0 { -along } else { along }
    }

    fn poked<S: Simulator>(&self, game: &Game<S>, is_held: bool, noticed: &Percept) -> (Command, Stage) {
        if self.frames == 0 && is_held {
            return (Command::Poke, Stage::Poked);
        }
        if is_held || noticed.grip.is_some() || self.frames < 2 {
            return (Command::Idle, Stage::Poked);
        }
        let moved = (noticed.centre - self.origin).dot(self.outward(game));
        (Command::Idle, if moved > LOOSE { Stage::Grasp } else { Stage::Done(MoveEnd::Stuck) })
    }

    fn push<S: Simulator>(&self, game: &Game<S>, noticed: &Percept, travel: f64, shake: DVec3) -> (Command, Stage) {
        let length = game.blocks().size(self.plan.body).x;
        let moved = (noticed.centre - self.origin).dot(self.outward(game));
        if moved > THROUGH * length {
            return (Command::Release, Stage::Grasp);
        }
        if noticed.stuck_s > STUCK || travel > GIVE_UP * length {
            return (Command::Release, Stage::Done(MoveEnd::Stuck));
        }
        let step = DRAW * game.world().frame();
        (displace(self.outward(game) * step + shake), Stage::Push(travel + step))
    }

    fn pull<S: Simulator>(&self, game: &Game<S>, noticed: &Percept, travel: f64, shake: DVec3) -> (Command, Stage) {
        let length = game.blocks().size(self.plan.body).x;
        if noticed.grip == Some(HoldGrip::Carry) {
            return (displace(shake), Stage::Clear(0.0));
        }
        if noticed.stuck_s > STUCK || travel > GIVE_UP * length {
            return (displace(shake), Stage::Back);
        }
        let step = DRAW * game.world().frame();
        let direction = rotation_about_z(self.askew) * self.outward(game);
        (displace(direction * step + shake), Stage::Pull(travel + step))
    }

    /// Moves the hand back to where the block was, and lets go when it is seen there.
    fn back<S: Simulator>(&self, game: &Game<S>, noticed: &Percept, hold: &Hold, shake: DVec3) -> (Command, Stage) {
        let left = (self.origin - noticed.centre).with_z(0.0);
        let is_back = left.length() < HOME || self.frames > RETURN;
        if is_back || noticed.grip == Some(HoldGrip::Carry) {
            return (Command::Idle, Stage::LetGo(MoveEnd::Stuck));
        }
        let frame = game.world().frame();
        let goal = (self.origin - self.grasped + hold.start - hold.goal).with_z(0.0);
        let step = if goal.length() > HOME {
            goal.clamp_length_max(DRAW * frame)
        } else {
            left.clamp_length_max(NUDGE * frame)
        };
        (displace(step + shake), Stage::Back)
    }

    fn clear<S: Simulator>(&mut self, game: &Game<S>, travel: f64, shake: DVec3) -> (Command, Stage) {
        if travel > CLEAR {
            let landing = self.landing(game);
            return (displace(shake), landing.map_or(Stage::LetGo(MoveEnd::Dropped), Stage::Rise));
        }
        let step = DRAW * game.world().frame();
        (displace(self.outward(game).with_z(0.0) * step + shake), Stage::Clear(travel + step))
    }

    /// Chooses the slot, and the offset and angle at which the hand will bring the block there.
    fn landing<S: Simulator>(&mut self, game: &Game<S>) -> Option<Landing> {
        let body = self.plan.body;
        let slots = game.slots(body);
        let away = |slot: &Slot| -> (usize, DVec3) {
            let near = game.blocks().bodies().filter(|other| *other != body).map(|other| game.blocks().position(other));
            let size = game.blocks().size(body);
            let offsets: Vec<DVec3> = near
                .map(|position| slot.position - position)
                .filter(|offset| offset.z.abs() < 0.5 * size.z && offset.truncate().length() < 1.6 * size.y)
                .collect();
            let direction = offsets.iter().map(|offset| offset.with_z(0.0).normalize_or_zero()).sum::<DVec3>();
            (offsets.len(), direction.normalize_or_zero())
        };
        // The middle first: both ends then have a neighbour on one side.
        let rank = |slot: &&Slot| (away(slot).0, slot.cell != 1);
        let slot = match self.plan.slot {
            Some(id) => *slots.iter().find(|slot| slot.id() == id)?,
            None => *slots.iter().min_by_key(rank)?,
        };
        let (neighbours, away) = away(&slot);
        let away = if neighbours == 1 { away } else { DVec3::ZERO };
        let wanted = nearest_alike(slot.orientation, game.blocks().orientation(body));
        let orientation = rotation_about_z(self.errors.angle()) * wanted;
        Some(Landing { slot, aim: self.errors.position() + away * BESIDE, orientation, away, tries: 0 })
    }

    fn rise<S: Simulator>(
        game: &Game<S>,
        noticed: &Percept,
        hold: &Hold,
        landing: Landing,
        shake: DVec3,
    ) -> (Command, Stage) {
        if noticed.centre.z > landing.crossing() - 0.004 {
            return (displace(shake), Stage::Turn(landing));
        }
        let goal = hold.goal - hold.arm();
        let step = (landing.crossing() - goal.z).clamp(0.0, CARRY * game.world().frame());
        (displace(DVec3::Z * step + shake), Stage::Rise(landing))
    }

    fn cross<S: Simulator>(
        game: &Game<S>,
        noticed: &Percept,
        hold: &Hold,
        landing: Landing,
        shake: DVec3,
    ) -> (Command, Stage) {
        let target = landing.centre().with_z(landing.crossing());
        let goal = hold.goal - hold.arm();
        let is_above = (noticed.centre - target).truncate().length() < ABOVE
            && (goal - target).truncate().length() < ABOVE
            && angle_between(noticed.orientation, landing.orientation) < ALIGNED;
        if is_above {
            return (displace(shake), Stage::Lower(landing));
        }
        // Up first, where the block came down on a neighbour.
        let target = if noticed.centre.z < landing.crossing() - 0.005 { goal.with_z(target.z) } else { target };
        let step = (target - goal).clamp_length_max(CARRY * game.world().frame());
        (displace(step + shake), Stage::Cross(landing))
    }

    fn lower<S: Simulator>(
        game: &Game<S>,
        noticed: &Percept,
        hold: &Hold,
        landing: Landing,
        shake: DVec3,
    ) -> (Command, Stage) {
        let height = game.blocks().size(hold.body).z;
        let above = noticed.centre.z - landing.slot.position.z;
        if noticed.upward > FELT {
            if above < TOO_HIGH * height {
                return (displace(shake), Stage::Stand(landing, 0));
            }
            if landing.tries >= MAX_TRIES {
                return (displace(shake), Stage::LetGo(MoveEnd::Dropped));
            }
            let aim = landing.aim + landing.away * BESIDE;
            return (displace(shake), Stage::Cross(Landing { aim, tries: landing.tries + 1, ..landing }));
        }
        let goal = (hold.goal - hold.arm()).z - landing.slot.position.z;
        let speed = if goal.min(above) < NEAR { TOUCH_DOWN } else { LOWER };
        (displace(DVec3::NEG_Z * (speed * game.world().frame()) + shake), Stage::Lower(landing))
    }
}

fn displace(displacement: DVec3) -> Command {
    Command::Move { displacement, slot: None, toward_viewer: None }
}
