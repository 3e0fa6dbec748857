//! Controller of the hand: carries out commands and gives the simulator a hand a frame.

use glam::{DQuat, DVec2, DVec3};
use serde::{Deserialize, Serialize};
use teeter_physics::{BodyId, ContactReport, Hand};

use crate::blocks::Blocks;
use crate::command::Refusal;
use crate::hand::clearance::TowerColumn;
use crate::hand::grip::{GripMode, HoldGrip};
use crate::hand::hold::{Hold, Task};
use crate::hand::limiter::LimitedGoal;
use crate::hand::placement_path::{Stage, Waypoint, waypoint};
use crate::headroom::is_free;
use crate::orientation::{angle_between, nearest_alike};
use crate::simulator::Simulator;
use crate::tower_map::{CellId, Slot, TowerMap};

/// Largest speed of the target of a careful hand, m/s.
const CAREFUL_SPEED: f64 = 0.03;
/// Largest displacement of the goal in a frame, m.
const MAX_DISPLACEMENT: f64 = 10.0;
/// Part of its largest force from which the hand shows that it gives all, and from which its target
/// gains no more lead.
const CAPPED: f64 = 0.97;
const SATURATED: f64 = 0.98;
/// Travel (m), speed (m/s) and time (s) of a poke.
const POKE_DEPTH: f64 = 0.006;
const POKE_SPEED: f64 = 0.04;
const POKE_TIME: f64 = 0.35;
/// Height above its slot below which a block that touches stands in it, m: more would be the edge
/// of a neighbour.
const STANDING: f64 = 0.002;
/// Upward contact force from which a block touches what bears it, N.
const TOUCHING: f64 = 0.03;
/// Time after which a block that does not come down is let go, s.
const PATIENCE: f64 = 6.0;
/// Distance from a slot within which a block is in it already, m.
const IN_SLOT: f64 = 0.012;
/// Angle up to which a hand that cannot rotate a block lays it into a slot, rad.
const MAX_ASKEW: f64 = 0.2;

/// Largest speed (m/s) and lead (m) of the target by grip.
fn limits(grip: HoldGrip) -> (f64, f64) {
    match grip {
        HoldGrip::Slide => (0.25, 0.012),
        HoldGrip::Carry => (0.5, 0.03),
        HoldGrip::Push => (0.12, 0.012),
    }
}

/// Ending of a hold without a command of the player.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ending {
    /// The block stands in its slot.
    Placed(CellId),
    /// The poke is over.
    Poked,
    /// The block did not come down.
    GivenUp,
}

/// Touched point of a block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// The point, in the block's frame, m.
    pub anchor: DVec3,
    /// Outward normal of the face that was touched, in the world.
    pub normal: DVec3,
}

/// Constants of the hand, and the block in it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HandController {
    max_force: f64,
    is_careful: bool,
    can_turn: bool,
    hold: Option<Hold>,
    /// Free slots for the carried block.
    slots: Vec<Slot>,
}

impl HandController {
    /// An empty hand. `can_turn` is false for one that cannot rotate a block.
    pub fn new(can_turn: bool) -> Self {
        Self { max_force: Hand::DEFAULT_FORCE, is_careful: false, can_turn, hold: None, slots: Vec::new() }
    }

    /// The block in the hand.
    pub fn hold(&self) -> Option<&Hold> {
        self.hold.as_ref()
    }

    /// Free slots for the carried block.
    pub fn slots(&self) -> &[Slot] {
        &self.slots
    }

    /// Returns true if the hand gives all its force.
    pub fn is_capped(&self, force: DVec3) -> bool {
        force.length() > CAPPED * self.max_force
    }

    /// Returns true if the state is one of a world of `count` bodies.
    pub fn is_of(&self, count: usize) -> bool {
        self.hold.as_ref().is_none_or(|hold| (hold.body.index()) < count)
    }

    /// Grasps a block. A poke in progress ends.
    pub fn grasp(&mut self, blocks: &Blocks, body: BodyId, touch: &Touch, mode: GripMode) -> Result<(), Refusal> {
        let Touch { anchor, normal } = *touch;
        check_body(blocks, body)?;
        check("anchor", anchor, anchor.abs().cmple(blocks.size(body)).all(), "a point of the block")?;
        let axis = -normal.normalize_or_zero();
        check("normal", normal, normal.is_finite() && axis != DVec3::ZERO, "a direction")?;
        match &self.hold {
            Some(hold) if !matches!(hold.task, Task::Poke { .. }) => return Err(Refusal::Holding(hold.body)),
            _ => {}
        }
        self.hold = Some(Hold::new(blocks, body, anchor, axis, mode));
        Ok(())
    }

    /// Moves the goal of the held block, and sets the slot that attracts it.
    pub fn displace(
        &mut self,
        blocks: &Blocks,
        displacement: DVec3,
        slot: Option<CellId>,
        toward_viewer: Option<DVec2>,
    ) -> Result<(), Refusal> {
        check("displacement", displacement, displacement.length() <= MAX_DISPLACEMENT, "at most 10 m")?;
        if let Some(direction) = toward_viewer {
            check("toward_viewer", direction, direction.is_finite(), "a direction")?;
        }
        let hold = self.follower()?;
        hold.displace(displacement, blocks);
        hold.slot = slot.filter(|_| hold.grip == HoldGrip::Carry);
        hold.toward_viewer = toward_viewer.and_then(DVec2::try_normalize).or(hold.toward_viewer);
        Ok(())
    }

    /// Rotates the orientation wanted for the carried block.
    pub fn rotate(&mut self, rotation: DQuat) -> Result<(), Refusal> {
        let is_rotation = rotation.is_finite() && rotation.length() > 1e-3 && rotation.length() < 1e3;
        check("rotation", rotation, is_rotation, "a quaternion")?;
        let can_turn = self.can_turn;
        let hold = self.follower()?;
        if hold.grip != HoldGrip::Carry {
            return Err(Refusal::NotCarried(hold.body));
        }
        if !can_turn {
            return Err(Refusal::CannotTurn);
        }
        hold.rotate(rotation.normalize());
        Ok(())
    }

    /// Begins to set a block down.
    pub fn place(&mut self, blocks: &Blocks, body: Option<BodyId>, slot: Option<CellId>) -> Result<(), Refusal> {
        let held = match &self.hold {
            Some(hold) if matches!(hold.task, Task::Place { .. }) => return Err(Refusal::Placing(hold.body)),
            Some(hold) if matches!(hold.task, Task::Follow) => Some(hold),
            _ => None,
        };
        let body = match (body, held) {
            (Some(body), Some(hold)) if body != hold.body => return Err(Refusal::Holding(hold.body)),
            (Some(body), _) => body,
            (None, Some(hold)) => hold.body,
            (None, None) => return Err(Refusal::NothingHeld),
        };
        check_body(blocks, body)?;
        if held.is_none_or(|hold| hold.grip != HoldGrip::Carry) && !is_free(blocks, body) {
            return Err(Refusal::NotFree(body));
        }
        let attracting = held.and_then(|hold| hold.slot);
        let slot = match slot.or(attracting) {
            Some(id) => self.slots_for(blocks, body).into_iter().find(|slot| slot.id() == id),
            None => self.nearest_slot(blocks, body),
        };
        let slot = slot.ok_or(Refusal::NoSlot(body))?;
        let mut hold = match self.hold.take() {
            Some(hold) if matches!(hold.task, Task::Follow) => hold,
            _ => Hold::new(blocks, body, DVec3::ZERO, DVec3::ZERO, GripMode::Carry),
        };
        hold.grip = HoldGrip::Carry;
        hold.slot = Some(slot.id());
        hold.task = Task::Place { slot, elapsed: 0.0 };
        self.hold = Some(hold);
        Ok(())
    }

    /// Turns the hold into a poke, or lets go where the block cannot be poked. Returns the block
    /// that was let go.
    pub fn poke(&mut self) -> Result<Option<BodyId>, Refusal> {
        let hold = self.follower()?;
        if !hold.can_be_poked() {
            return self.release().map(Some);
        }
        (hold.grip, hold.orientation, hold.slot) = (HoldGrip::Push, None, None);
        hold.goal = hold.point + hold.axis * POKE_DEPTH;
        hold.task = Task::Poke { elapsed: 0.0 };
        self.slots.clear();
        Ok(None)
    }

    /// Lets go and returns the block.
    pub fn release(&mut self) -> Result<BodyId, Refusal> {
        self.slots.clear();
        self.hold.take().map(|hold| hold.body).ok_or(Refusal::NothingHeld)
    }

    /// Sets constants of the hand.
    pub fn set(
        &mut self,
        max_force: Option<f64>,
        careful: Option<bool>,
        can_turn: Option<bool>,
        grip: Option<GripMode>,
    ) -> Result<(), Refusal> {
        if let Some(force) = max_force {
            check("max_force", force, (0.0..=Hand::MAX_FORCE).contains(&force), "0 to 50 N")?;
            self.max_force = force;
        }
        self.is_careful = careful.unwrap_or(self.is_careful);
        self.can_turn = can_turn.unwrap_or(self.can_turn);
        if let (Some(hold), Some(mode)) = (&mut self.hold, grip) {
            hold.mode = mode;
        }
        Ok(())
    }

    /// Advances the target by a frame and returns the hand that pulls in it.
    pub fn hand<S: Simulator>(&mut self, blocks: &Blocks, simulator: &S) -> Option<Hand> {
        let (goal, max_force) = (self.goal(blocks)?, self.max_force);
        let hold = self.hold.as_mut()?;
        let stiffness = simulator.hand_stiffness();
        let max_lead = match stiffness {
            Some(stiffness) if hold.grip != HoldGrip::Carry => max_force / stiffness,
            _ => goal.max_lead,
        };
        let goal = LimitedGoal { max_lead, ..goal };
        let is_saturated = stiffness.is_none() && hold.force.length() > SATURATED * max_force;
        hold.limiter.advance(&goal, hold.point, is_saturated, simulator.frame());
        Some(Hand {
            body: hold.body,
            anchor: hold.anchor,
            target: hold.limiter.position(),
            orientation: goal.orientation.map(|_| hold.limiter.orientation()),
            grip: hold.grip.to_physics(hold.axis),
            max_force,
            max_torque: Hand::DEFAULT_TORQUE,
        })
    }

    /// Takes in the end of a frame of `dt` (s), with the force of the hand on the block (N) and the
    /// block's contacts. Returns how the hold ended, where it did.
    pub fn observe(&mut self, blocks: &Blocks, force: DVec3, contacts: &[ContactReport], dt: f64) -> Option<Ending> {
        let is_capped = self.is_capped(force);
        let hold = self.hold.as_mut()?;
        hold.observe(blocks, force, is_capped, dt);
        let body = hold.body;
        self.slots = if hold.grip == HoldGrip::Carry { self.slots_for(blocks, body) } else { Vec::new() };
        let hold = self.hold.as_mut()?;
        hold.slot = hold.slot.filter(|id| self.slots.iter().any(|slot| slot.id() == *id) || hold.task != Task::Follow);
        if let Some(column) = TowerColumn::under(&self.slots, blocks.size(body)) {
            hold.is_clear |= column.is_clear(blocks.position(body));
        }
        let ending = match hold.task {
            Task::Follow => None,
            Task::Poke { elapsed } => (elapsed >= POKE_TIME).then_some(Ending::Poked),
            Task::Place { slot, elapsed } => {
                let upward: f64 = contacts.iter().map(|c| c.normal.z.max(0.0) * c.force).sum();
                let left = blocks.position(body).z - slot.position.z;
                let is_low = waypoint_of(hold, blocks, &slot).stage == Stage::Lower && left < STANDING;
                if is_low && upward > TOUCHING {
                    Some(Ending::Placed(slot.id()))
                } else {
                    (elapsed > PATIENCE).then_some(Ending::GivenUp)
                }
            }
        };
        if ending.is_some() {
            self.hold = None;
            self.slots.clear();
        }
        ending
    }

    /// Slots for a block.
    pub fn slots_for(&self, blocks: &Blocks, body: BodyId) -> Vec<Slot> {
        let mut slots = TowerMap::new(blocks, Some(body)).slots(blocks.size(body));
        if !self.can_turn {
            let orientation = blocks.orientation(body);
            let askew = |slot: &Slot| angle_between(nearest_alike(slot.orientation, orientation), orientation);
            slots.retain(|slot| askew(slot) < MAX_ASKEW);
            slots.iter_mut().for_each(|slot| slot.orientation = orientation);
        }
        slots
    }

    /// Returns true if a block can be placed now: it is held in the air or free, and a slot is free
    /// for it.
    pub fn can_place(&self, blocks: &Blocks, body: BodyId) -> bool {
        let is_ready = match &self.hold {
            Some(hold) if hold.body == body => match hold.task {
                Task::Follow => hold.grip == HoldGrip::Carry || is_free(blocks, body),
                Task::Place { .. } => false,
                Task::Poke { .. } => is_free(blocks, body),
            },
            Some(hold) if !matches!(hold.task, Task::Poke { .. }) => false,
            _ => is_free(blocks, body),
        };
        is_ready && self.nearest_slot(blocks, body).is_some()
    }

    /// The nearest slot that a block is not in already.
    fn nearest_slot(&self, blocks: &Blocks, body: BodyId) -> Option<Slot> {
        let centre = blocks.position(body);
        let distance = |slot: &Slot| slot.position.distance(centre);
        let slots = self.slots_for(blocks, body).into_iter().filter(|slot| distance(slot) > IN_SLOT);
        slots.min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    /// The hold that follows the player's goal.
    fn follower(&mut self) -> Result<&mut Hold, Refusal> {
        match &mut self.hold {
            Some(Hold { body, task: Task::Place { .. }, .. }) => Err(Refusal::Placing(*body)),
            Some(hold) if hold.task == Task::Follow => Ok(hold),
            _ => Err(Refusal::NothingHeld),
        }
    }

    /// Goal of the target in the next frame.
    fn goal(&self, blocks: &Blocks) -> Option<LimitedGoal> {
        let hold = self.hold.as_ref()?;
        let (speed, max_lead) = limits(hold.grip);
        let max_speed = if self.is_careful { CAREFUL_SPEED } else { speed };
        let goal = LimitedGoal { position: hold.goal, orientation: hold.orientation, max_speed, max_lead };
        let attracting = hold.slot.and_then(|id| self.slots.iter().find(|slot| slot.id() == id));
        let toward = |next: Waypoint, max_speed: f64| LimitedGoal {
            position: next.centre + next.orientation * hold.anchor,
            orientation: Some(next.orientation),
            max_speed,
            max_lead,
        };
        Some(match (hold.task, attracting) {
            (Task::Poke { .. }, _) => LimitedGoal { max_speed: POKE_SPEED, ..goal },
            (Task::Place { slot, .. }, _) => {
                let next = waypoint_of(hold, blocks, &slot);
                toward(next, next.max_speed)
            }
            (Task::Follow, Some(slot)) => {
                let next = waypoint_of(hold, blocks, slot);
                toward(next, max_speed.min(next.max_speed))
            }
            (Task::Follow, None) if hold.grip == HoldGrip::Carry && hold.is_clear && hold.mode == GripMode::Auto => {
                LimitedGoal { position: self.clear_goal(hold, blocks), ..goal }
            }
            (Task::Follow, None) => goal,
        })
    }

    /// The player's goal, moved out of the tower.
    fn clear_goal(&self, hold: &Hold, blocks: &Blocks) -> DVec3 {
        let Some(column) = TowerColumn::under(&self.slots, blocks.size(hold.body)) else { return hold.goal };
        let present = blocks.position(hold.body);
        let away = (present - column.axis).with_z(0.0).normalize_or(DVec3::X);
        let toward_viewer = hold.toward_viewer.map_or(away, |direction| direction.extend(0.0));
        column.keep_clear(hold.goal - hold.arm(), present, toward_viewer) + hold.arm()
    }
}

/// Next waypoint of a held block to a slot.
fn waypoint_of(hold: &Hold, blocks: &Blocks, slot: &Slot) -> Waypoint {
    let set_down = matches!(hold.task, Task::Place { .. });
    waypoint(blocks.position(hold.body), blocks.orientation(hold.body), slot, set_down)
}

fn check_body(blocks: &Blocks, body: BodyId) -> Result<(), Refusal> {
    let count = blocks.len();
    if (body.index()) < count { Ok(()) } else { Err(Refusal::UnknownBody { body, count }) }
}

fn check(
    field: &'static str,
    value: impl std::fmt::Display,
    is_valid: bool,
    expected: &'static str,
) -> Result<(), Refusal> {
    if is_valid { Ok(()) } else { Err(Refusal::Field { field, value: value.to_string(), expected }) }
}
