//! Inputs over time: changes of gravity, hand, forces and drives, each of which holds until the
//! next.

use glam::{DQuat, DVec3};
use teeter_physics::{AppliedForce, BodyId, Drive, Grip, Hand, Input, World};

/// Change of the input at a time. A part that is none stays as it was.
///
/// ```
/// use glam::DVec3;
/// use teeter_study::Change;
///
/// // gravity leans towards x from the second second on
/// let tilt = Change { time: 2.0, gravity: Some(Some(DVec3::new(1.0, 0.0, -9.7))), ..Change::default() };
/// assert_eq!(tilt.forces, None);
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Change {
    /// Time from which the change holds, s: it begins with the frame whose start is nearest.
    pub time: f64,
    /// Gravity, m/s²; some none returns to that of the scene.
    pub gravity: Option<Option<DVec3>>,
    /// Hand; some none lets go.
    pub hand: Option<Option<HandMotion>>,
    /// Forces, instead of all before; empty for none.
    pub forces: Option<Vec<AppliedForce>>,
    /// Drives, instead of all before; empty for none.
    pub drives: Option<Vec<Drive>>,
}

/// Hand whose target moves at a constant velocity.
///
/// ```
/// use glam::DVec3;
/// use teeter_physics::{BodyId, Grip};
/// use teeter_study::{HandMotion, HandOrientation};
///
/// let draw = HandMotion { velocity: DVec3::X * 0.05, ..HandMotion::new(BodyId(7), Grip::Slide) };
/// assert_eq!((draw.target, draw.orientation), (None, HandOrientation::Present));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct HandMotion {
    /// Body in the hand.
    pub body: BodyId,
    /// Grip.
    pub grip: Grip,
    /// Grasped point in the body's frame, m.
    pub anchor: DVec3,
    /// Target of the grasped point when the change begins, m; none is where the point is then.
    pub target: Option<DVec3>,
    /// Velocity of the target from then on, m/s.
    pub velocity: DVec3,
    /// Target orientation of the body.
    pub orientation: HandOrientation,
    /// Maximum force, N.
    pub max_force: f64,
    /// Maximum torque, N m.
    pub max_torque: f64,
}

/// Target orientation of the body in a [`HandMotion`].
///
/// ```
/// use glam::DQuat;
/// use teeter_study::HandOrientation;
///
/// assert_ne!(HandOrientation::Free, HandOrientation::Fixed(DQuat::IDENTITY));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum HandOrientation {
    /// Orientation that the body has when the change begins.
    Present,
    /// None: the body turns freely.
    Free,
    /// Given orientation.
    Fixed(DQuat),
}

impl HandMotion {
    /// A hand at rest at the centre of a body, with the default limits. It keeps the orientation of
    /// the body, except as a fingertip.
    pub fn new(body: BodyId, grip: Grip) -> Self {
        let orientation = match grip {
            Grip::Slide | Grip::Carry => HandOrientation::Present,
            Grip::Push { .. } => HandOrientation::Free,
        };
        let (max_force, max_torque) = (Hand::DEFAULT_FORCE, Hand::DEFAULT_TORQUE);
        let (anchor, target, velocity) = (DVec3::ZERO, None, DVec3::ZERO);
        Self { body, grip, anchor, target, velocity, orientation, max_force, max_torque }
    }

    /// Returns the hand with its target where the motion begins.
    fn begin(&self, world: &World) -> Hand {
        let pose = world.pose(self.body);
        let orientation = match self.orientation {
            HandOrientation::Present => Some(pose.orientation),
            HandOrientation::Free => None,
            HandOrientation::Fixed(orientation) => Some(orientation),
        };
        let Self { body, grip, anchor, max_force, max_torque, .. } = *self;
        let target = self.target.unwrap_or_else(|| pose.transform_point(anchor));
        Hand { body, anchor, target, orientation, grip, max_force, max_torque }
    }
}

/// Changes of the input in the order of their times, and the input at present.
///
/// ```
/// use glam::DVec3;
/// use teeter_physics::{AppliedForce, BodyId, Params, World};
/// use teeter_study::{Change, Timeline};
///
/// let mut world = World::new(&teeter_scene::named("block").unwrap(), Params::default())?;
/// let push = AppliedForce::at_center(BodyId(0), DVec3::X * 0.2);
/// let on = Change { time: 1.0, forces: Some(vec![push]), ..Change::default() };
/// let off = Change { time: 2.0, forces: Some(Vec::new()), ..Change::default() };
/// let mut timeline = Timeline::new(vec![on, off]);
/// for frame in 0..150 {
///     let input = timeline.input(&world);
///     assert_eq!(input.forces.len(), usize::from((60..120).contains(&frame)));
///     world.step(input);
/// }
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Timeline {
    /// In the order of their times.
    changes: Vec<Change>,
    /// Number of changes that have begun.
    begun: usize,
    input: Input,
    /// Start of the hand's motion: target (m), velocity (m/s) and time (s).
    motion: Option<(DVec3, DVec3, f64)>,
}

impl Timeline {
    /// Creates a timeline from changes in any order; of two with the same time the later one
    /// prevails.
    pub fn new(mut changes: Vec<Change>) -> Self {
        changes.sort_by(|a, b| a.time.total_cmp(&b.time));
        Self { changes, ..Self::default() }
    }

    /// Returns the input of the frame that `world` is about to step. To be called once before each
    /// step.
    pub fn input(&mut self, world: &World) -> &Input {
        let frame = world.params().frame;
        while let Some(change) = self.changes.get(self.begun).filter(|next| next.time <= world.time() + 0.5 * frame) {
            self.begun += 1;
            begin(&mut self.input, &mut self.motion, change, world);
        }
        if let (Some(hand), Some((target, velocity, start))) = (&mut self.input.hand, self.motion) {
            // The target of an input is that at the end of the frame.
            hand.target = target + velocity * (world.time() + frame - start);
        }
        &self.input
    }

    /// Changes that have not begun.
    pub fn pending(&self) -> &[Change] {
        &self.changes[self.begun..]
    }
}

/// Applies a change to the input.
fn begin(input: &mut Input, motion: &mut Option<(DVec3, DVec3, f64)>, change: &Change, world: &World) {
    if let Some(gravity) = change.gravity {
        input.gravity = gravity;
    }
    if let Some(hand) = &change.hand {
        input.hand = hand.as_ref().map(|hand| hand.begin(world));
        *motion = hand.as_ref().zip(input.hand.as_ref()).map(|(to, hand)| (hand.target, to.velocity, world.time()));
    }
    if let Some(forces) = &change.forces {
        input.forces.clone_from(forces);
    }
    if let Some(drives) = &change.drives {
        input.drives.clone_from(drives);
    }
}

#[cfg(test)]
mod tests {
    use teeter_physics::Params;
    use teeter_scene::named;

    use super::*;

    fn world() -> World {
        World::new(&named("block").unwrap(), Params::default()).unwrap()
    }

    /// Inputs of `frames` frames.
    fn inputs(changes: Vec<Change>, frames: usize) -> Vec<Input> {
        let (mut world, mut timeline) = (world(), Timeline::new(changes));
        let mut step = || {
            let input = timeline.input(&world).clone();
            world.step(&input);
            input
        };
        (0..frames).map(|_| step()).collect()
    }

    #[test]
    fn a_target_moves_at_its_velocity_from_the_time_of_the_change() {
        let hand = HandMotion {
            target: Some(DVec3::new(0.0, 0.0, 0.05)),
            velocity: DVec3::new(0.06, 0.0, 0.0),
            ..HandMotion::new(BodyId(0), Grip::Carry)
        };
        let inputs = inputs(vec![Change { time: 0.5, hand: Some(Some(hand)), ..Change::default() }], 60);
        assert!(inputs[..30].iter().all(|input| input.hand.is_none()));
        for (frame, input) in inputs[30..].iter().enumerate() {
            let expected = DVec3::new(1e-3 * (frame + 1) as f64, 0.0, 0.05);
            let target = input.hand.as_ref().unwrap().target;
            assert!(target.distance(expected) < 1e-12, "{frame}: {target} {expected}");
        }
    }

    #[test]
    fn a_target_that_is_not_given_is_where_the_point_is() {
        let anchor = DVec3::new(0.01, 0.0, 0.0);
        let hand = HandMotion { anchor, ..HandMotion::new(BodyId(0), Grip::Slide) };
        let inputs = inputs(vec![Change { hand: Some(Some(hand)), ..Change::default() }], 1);
        let hand = inputs[0].hand.as_ref().unwrap();
        let pose = world().pose(BodyId(0));
        assert_eq!((hand.target, hand.orientation), (pose.transform_point(anchor), Some(pose.orientation)));
    }

    #[test]
    fn a_part_that_a_change_leaves_out_stays() {
        let gravity = DVec3::new(1.0, 0.0, -9.0);
        let force = AppliedForce::at_center(BodyId(0), DVec3::X * 0.01);
        let at = |frame: f64| Change { time: frame / 60.0, ..Change::default() };
        let changes = vec![
            Change { gravity: Some(None), ..at(3.0) },
            Change { gravity: Some(Some(gravity)), ..at(1.0) },
            Change { forces: Some(vec![force]), ..at(2.0) },
        ];
        let inputs = inputs(changes, 4);
        let gravities: Vec<_> = inputs.iter().map(|input| input.gravity).collect();
        assert_eq!(gravities, [None, Some(gravity), Some(gravity), None]);
        let forces: Vec<_> = inputs.iter().map(|input| input.forces.len()).collect();
        assert_eq!(forces, [0, 0, 1, 1]);
    }
}
