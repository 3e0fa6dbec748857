//! Input of a step, split by cluster.

use glam::DVec3;

use crate::actuator::drive::DriveController;
use crate::actuator::hand::{BatchTime, HandController, HandTarget};
use crate::actuator::limits;
use crate::body::{Bodies, Shapes};
use crate::body_id::BodyId;
use crate::input::{AppliedForce, Drive, Hand, Input};

/// Input of a step for one cluster; body indices are those of the cluster.
#[derive(Debug, Clone, Default)]
pub struct ClusterInput {
    /// Hand, and its target at the start of the frame; the latter is none for a hand that has just
    /// grasped.
    pub hand: Option<(Hand, Option<HandTarget>)>,
    /// Forces, with their values at the start of the frame, N.
    pub forces: Vec<(AppliedForce, DVec3)>,
    /// Drives.
    pub drives: Vec<Drive>,
}

/// Hand and drives during a batch.
#[derive(Debug, Clone, Default)]
pub struct Actuators {
    /// Controller of the hand.
    pub hand: Option<HandController>,
    /// Controllers of the drives.
    pub drives: Vec<DriveController>,
}

impl Actuators {
    /// Work on the bodies in a batch of substeps of `h` (s), J; `twist` returns the velocity and
    /// spin of a body at its end (m/s, rad/s).
    pub fn work(&self, h: f64, twist: impl Fn(usize) -> (DVec3, DVec3)) -> f64 {
        let hand = self.hand.iter().map(|hand| hand.work.at_end(h, twist(hand.body())));
        hand.chain(self.drives.iter().map(|drive| drive.work.at_end(h, twist(drive.body())))).sum()
    }
}

impl ClusterInput {
    /// Splits an input by cluster. `target` and `previous` are hand and forces at the end of the
    /// last step; `locations` holds the cluster of each body and its index there.
    pub fn split(
        input: &Input,
        target: Option<HandTarget>,
        previous: &[AppliedForce],
        (clusters, locations): (usize, &[(u32, u32)]),
    ) -> Vec<Self> {
        let mut inputs = vec![Self::default(); clusters];
        let location = |body: BodyId| {
            let (cluster, i) = locations[body.index()];
            (cluster as usize, BodyId(i))
        };
        if let Some(hand) = &input.hand {
            let (c, i) = location(hand.body);
            let from = target.filter(|target| target.body == hand.body).map(|target| HandTarget { body: i, ..target });
            inputs[c].hand = Some((Hand { body: i, ..hand.clone() }, from));
        }
        for (k, force) in input.forces.iter().enumerate() {
            let (c, i) = location(force.body);
            let last = ramp_start(previous, k, force);
            inputs[c].forces.push((AppliedForce { body: i, ..*force }, last));
        }
        for drive in &input.drives {
            let (c, i) = location(drive.body);
            inputs[c].drives.push(Drive { body: i, ..*drive });
        }
        inputs
    }

    /// Indices of the bodies that the input acts on.
    pub fn bodies(&self) -> impl Iterator<Item = usize> {
        let hand = self.hand.iter().map(|(hand, _)| hand.body);
        let all = hand.chain(self.forces.iter().map(|(f, _)| f.body)).chain(self.drives.iter().map(|d| d.body));
        all.map(BodyId::index)
    }

    /// Force (N) and torque (N m) of the applied forces on body `i` when a share `progress` of the
    /// frame has passed, within the limits of the body.
    pub fn force(&self, shapes: &Shapes, bodies: &Bodies, i: usize, progress: f64) -> (DVec3, DVec3) {
        let mut sum = (DVec3::ZERO, DVec3::ZERO);
        for (applied, before) in self.forces.iter().filter(|(f, _)| f.body.index() == i) {
            let force = *before + (applied.force - *before) * progress;
            sum.0 += force;
            sum.1 += (bodies.orientation[i] * applied.point).cross(force);
        }
        if self.forces.is_empty() { sum } else { limits::limited(shapes, i, bodies.orientation[i], sum) }
    }

    /// Controllers of hand and drives for a batch.
    pub fn actuators(&mut self, batch: &BatchTime, shapes: &Shapes, bodies: &Bodies) -> Actuators {
        let hand = self.hand.as_mut().map(|(hand, from)| {
            let from = from.get_or_insert_with(|| HandTarget::at_grasp(hand, bodies));
            HandController::new(hand, from, batch, shapes, bodies)
        });
        Actuators { hand, drives: self.drives.iter().map(|d| DriveController::new(d, shapes, bodies)).collect() }
    }
}

/// Force at which number `k` of the forces begins its ramp, N: that of the same body and point in
/// the last step. Forces mostly keep their order, and one may act at the same point as another.
fn ramp_start(previous: &[AppliedForce], k: usize, force: &AppliedForce) -> DVec3 {
    let same = |f: &&AppliedForce| f.body == force.body && f.point == force.point;
    previous.get(k).filter(same).or_else(|| previous.iter().find(same)).map_or(DVec3::ZERO, |f| f.force)
}

/// Speeds to which an input may accelerate bodies in a frame of `frame` (s), m/s: the sum of the
/// target speeds and of the speeds that the forces give, one entry a body. `target` and `previous`
/// are hand and forces at the end of the last step.
pub fn input_speeds<'a>(
    input: &Input,
    (target, previous): (Option<&HandTarget>, &[AppliedForce]),
    frame: f64,
    shapes: impl Fn(BodyId) -> (&'a Shapes, usize),
) -> Vec<(BodyId, f64)> {
    let mass = |body: BodyId| {
        let (shapes, i) = shapes(body);
        shapes.mass[i]
    };
    let drives = input.drives.iter().map(|d| (d.body, d.velocity.length()));
    let forces = input.forces.iter().enumerate().map(|(k, f)| {
        let force = f.force.length().max(ramp_start(previous, k, f).length());
        let (shapes, i) = shapes(f.body);
        (f.body, limits::speed_gain(shapes, i, (force, f.point.length()), frame))
    });
    let hand = input.hand.iter().map(|hand| {
        let distance = target
            .filter(|target| target.body == hand.body)
            .map_or(0.0, |target| (hand.target - target.target).length());
        (hand.body, distance / frame + hand.max_force / mass(hand.body) * frame)
    });
    let mut speeds: Vec<(BodyId, f64)> = drives.chain(forces).chain(hand).collect();
    speeds.sort_by_key(|&(body, _)| body);
    speeds.dedup_by(|next, sum| {
        let same = next.0 == sum.0;
        if same {
            sum.1 += next.1;
        }
        same
    });
    speeds
}
