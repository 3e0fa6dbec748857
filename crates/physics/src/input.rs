//! Everything that acts on a world from outside during one step.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

use crate::body_id::BodyId;

/// Everything that acts on a world from outside during one step.
///
/// A step ignores parts that name no body, or have a number that is not finite, and reduces what is
/// above these limits. So an input of any size harms no body but the one it names.
///
/// | what | limit |
/// |---|---|
/// | gravity | 100 m/s² |
/// | force of a hand | [`Hand::MAX_FORCE`], 50 N |
/// | torque of a hand | `MAX_FORCE` times half the diagonal of the body |
/// | all forces on a body, and each of a hand and a drive | mass times 1e5 m/s² |
/// | all torques of forces on a body, and each of a hand and a drive | that which accelerates a corner by 1e5 m/s² |
/// | velocity of a drive | 1e3 m/s |
/// | distance of a hand's anchor from the centre | the diagonal of the body |
/// | a hand's target and the point of a force | 1e6 m from the origin and the centre |
///
/// ```
/// use glam::DVec3;
/// use teeter_physics::{AppliedForce, BodyId, Input, Params, World};
///
/// let mut world = World::new(&teeter_scene::named("column").unwrap(), Params::default())?;
/// let push = AppliedForce { body: BodyId(0), point: DVec3::ZERO, force: DVec3::new(0.01, 0.0, 0.0) };
/// let report = world.step(&Input::force(push));
/// assert!(report.quarantined.is_empty());
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Input {
    /// Gravity, m/s²; the scene's where absent.
    pub gravity: Option<DVec3>,
    /// The player's hand.
    pub hand: Option<Hand>,
    /// Constant forces.
    pub forces: Vec<AppliedForce>,
    /// Bodies moved at a given velocity with a large force: for experiments, not for play.
    pub drives: Vec<Drive>,
}

impl Input {
    /// A hand and nothing else.
    pub fn hand(hand: Hand) -> Self {
        Self { hand: Some(hand), ..Self::default() }
    }

    /// A force and nothing else.
    pub fn force(force: AppliedForce) -> Self {
        Self::forces(vec![force])
    }

    /// Forces and nothing else.
    pub fn forces(forces: Vec<AppliedForce>) -> Self {
        Self { forces, ..Self::default() }
    }

    /// Drives and nothing else.
    pub fn drives(drives: Vec<Drive>) -> Self {
        Self { drives, ..Self::default() }
    }

    /// Gravity of this direction and size (m/s²) and nothing else.
    pub fn gravity(gravity: DVec3) -> Self {
        Self { gravity: Some(gravity), ..Self::default() }
    }
}

/// Grip of a hand on a block.
///
/// ```
/// use glam::{DQuat, DVec3};
/// use teeter_physics::{BodyId, Grip, Hand};
///
/// let push = Hand::push(BodyId(3), DVec3::ZERO, DVec3::ZERO, DVec3::X);
/// assert_eq!(push.grip, Grip::Push { axis: DVec3::X });
/// // a fingertip holds no orientation
/// assert_eq!(push.orientation, None);
/// let slide = Hand::slide(BodyId(3), DVec3::ZERO, DVec3::ZERO, DQuat::IDENTITY);
/// assert_eq!(slide.grip, Grip::Slide);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Grip {
    /// Fingers on a block in the tower: they steer it sideways and keep its orientation. Where they
    /// keep an orientation they carry four fifths of its weight; upwards they give no more than the
    /// block's own weight, so they cannot lift the tower.
    Slide,
    /// A block in the air: moved in all directions, its weight carried.
    Carry,
    /// A fingertip: pushes along `axis` (unit vector, world), never pulls, and holds no
    /// orientation.
    Push {
        /// Direction of the push, unit vector in the world.
        axis: DVec3,
    },
}

/// A hand: a critically damped spring between a point of a body and a target, with limited force
/// and torque.
///
/// Built by [`Hand::slide`], [`Hand::carry`] and [`Hand::push`]. In JSON `grip` is `"slide"`,
/// `"carry"` or `"push"`, and `axis` is the direction of a push.
///
/// ```
/// use glam::DVec3;
/// use teeter_physics::{BodyId, Hand, Input, Params, World};
///
/// let mut world = World::new(&teeter_scene::named("tower").unwrap(), Params::default())?;
/// let body = BodyId(52);
/// let pose = world.pose(body);
/// // hold the block at the middle of its end and draw it 1 mm along itself
/// let anchor = DVec3::X * (0.5 * world.size(body).x);
/// let target = pose.transform_point(anchor + DVec3::X * 1e-3);
/// let hand = Hand::slide(body, anchor, target, pose.orientation).with_max_force(2.0);
/// let report = world.step(&Input::hand(hand));
/// assert!(report.hand.unwrap().force.length() <= 2.0);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(from = "HandRecord", into = "HandRecord")]
pub struct Hand {
    /// The body it holds.
    pub body: BodyId,
    /// The grasped point in the body's frame, m.
    pub anchor: DVec3,
    /// Target of the grasped point at the end of the step, m. Within the step the target moves at a
    /// constant velocity from that of the last step.
    pub target: DVec3,
    /// Target orientation of the body (x, y, z, w), reached in the same manner; none leaves it
    /// free.
    pub orientation: Option<DQuat>,
    /// Grip.
    pub grip: Grip,
    /// Maximum force, N.
    pub max_force: f64,
    /// Maximum torque, N m; a step clamps more than [`Hand::MAX_FORCE`] at half the diagonal of the
    /// body.
    pub max_torque: f64,
}

impl Hand {
    /// Maximum force of a careful hand, N: with less a tower of 10 N can only be tipped near its
    /// top.
    pub const DEFAULT_FORCE: f64 = 4.0;
    /// Upper limit of the force of any hand, N: a step clamps larger ones.
    pub const MAX_FORCE: f64 = 50.0;
    /// Maximum torque of a careful hand, N m: twice what holds a block level by its end.
    pub const DEFAULT_TORQUE: f64 = 0.02;

    /// Draws a block along the tower, keeping its orientation, with the default limits.
    pub fn slide(body: BodyId, anchor: DVec3, target: DVec3, orientation: DQuat) -> Self {
        Self::new(body, anchor, target, Some(orientation), Grip::Slide)
    }

    /// Carries a block through the air, with the default limits.
    pub fn carry(body: BodyId, anchor: DVec3, target: DVec3, orientation: DQuat) -> Self {
        Self::new(body, anchor, target, Some(orientation), Grip::Carry)
    }

    /// Pushes a block with a fingertip along `axis` (unit vector, world), with the default limits.
    pub fn push(body: BodyId, anchor: DVec3, target: DVec3, axis: DVec3) -> Self {
        Self::new(body, anchor, target, None, Grip::Push { axis })
    }

    fn new(body: BodyId, anchor: DVec3, target: DVec3, orientation: Option<DQuat>, grip: Grip) -> Self {
        let (max_force, max_torque) = (Self::DEFAULT_FORCE, Self::DEFAULT_TORQUE);
        Self { body, anchor, target, orientation, grip, max_force, max_torque }
    }

    /// Leaves the orientation of the body free.
    pub fn without_orientation(self) -> Self {
        Self { orientation: None, ..self }
    }

    /// Limits the force, N.
    pub fn with_max_force(self, max_force: f64) -> Self {
        Self { max_force, ..self }
    }

    /// Limits the torque, N m.
    pub fn with_max_torque(self, max_torque: f64) -> Self {
        Self { max_torque, ..self }
    }
}

/// A [`Hand`] as it stands in JSON.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct HandRecord {
    body: BodyId,
    anchor: DVec3,
    target: DVec3,
    #[serde(default)]
    orientation: Option<DQuat>,
    grip: GripName,
    /// Direction of a push; other grips ignore it.
    #[serde(default)]
    axis: DVec3,
    #[serde(default = "default_force")]
    max_force: f64,
    #[serde(default = "default_torque")]
    max_torque: f64,
}

#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum GripName {
    Slide,
    Carry,
    Push,
}

fn default_force() -> f64 {
    Hand::DEFAULT_FORCE
}

fn default_torque() -> f64 {
    Hand::DEFAULT_TORQUE
}

impl From<HandRecord> for Hand {
    fn from(record: HandRecord) -> Self {
        let HandRecord { body, anchor, target, orientation, grip, axis, max_force, max_torque } = record;
        let grip = match grip {
            GripName::Slide => Grip::Slide,
            GripName::Carry => Grip::Carry,
            GripName::Push => Grip::Push { axis },
        };
        Self { body, anchor, target, orientation, grip, max_force, max_torque }
    }
}

impl From<Hand> for HandRecord {
    fn from(hand: Hand) -> Self {
        let Hand { body, anchor, target, orientation, grip, max_force, max_torque } = hand;
        let (grip, axis) = match grip {
            Grip::Slide => (GripName::Slide, DVec3::ZERO),
            Grip::Carry => (GripName::Carry, DVec3::ZERO),
            Grip::Push { axis } => (GripName::Push, axis),
        };
        Self { body, anchor, target, orientation, grip, axis, max_force, max_torque }
    }
}

/// A force at a point that moves with a body.
///
/// ```
/// use glam::DVec3;
/// use teeter_physics::{AppliedForce, BodyId, Input, Params, World};
///
/// // half of what friction of 0.4 holds: the block stays
/// let mut world = World::new(&teeter_scene::named("block").unwrap(), Params::default())?;
/// let body = BodyId(0);
/// world.run_for(1.0);
/// let force = DVec3::X * (0.5 * 0.4 * world.mass(body) * 9.81);
/// let before = world.pose(body).position.x;
/// world.run_with(1.0, &Input::force(AppliedForce::at_center(body, force)));
/// assert!((world.pose(body).position.x - before).abs() < 1e-5);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AppliedForce {
    /// The body it acts on.
    pub body: BodyId,
    /// Point of attack in the body's frame, m.
    #[serde(default)]
    pub point: DVec3,
    /// Force in the world at the end of the step, N; it ramps linearly from that of the last step.
    pub force: DVec3,
}

impl AppliedForce {
    /// A force (N) at the centre of a body.
    pub fn at_center(body: BodyId, force: DVec3) -> Self {
        Self { body, point: DVec3::ZERO, force }
    }
}

/// A velocity imposed on a body during one step, with a large but limited force.
///
/// ```
/// use glam::DVec3;
/// use teeter_physics::{BodyId, Drive, Input, Params, World};
///
/// let mut world = World::new(&teeter_scene::named("block").unwrap(), Params::default())?;
/// let before = world.pose(BodyId(0)).position.x;
/// world.run_with(1.0, &Input::drives(vec![Drive::new(BodyId(0), DVec3::X * 0.1)]));
/// assert!((world.pose(BodyId(0)).position.x - before - 0.1).abs() < 2e-3);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Drive {
    /// The body it moves.
    pub body: BodyId,
    /// Velocity of its centre, m/s; the drive keeps the body from rotating.
    pub velocity: DVec3,
    /// Maximum force, N.
    #[serde(default = "default_drive_force")]
    pub max_force: f64,
}

impl Drive {
    /// Maximum force, N: a hundred tight blocks.
    pub const DEFAULT_FORCE: f64 = 100.0;

    /// Moves `body` at `velocity` (m/s) with the default force.
    pub fn new(body: BodyId, velocity: DVec3) -> Self {
        Self { body, velocity, max_force: Self::DEFAULT_FORCE }
    }

    /// Limits the force, N.
    pub fn with_max_force(self, max_force: f64) -> Self {
        Self { max_force, ..self }
    }
}

fn default_drive_force() -> f64 {
    Drive::DEFAULT_FORCE
}
