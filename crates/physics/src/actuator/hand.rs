//! Hand: a critically damped spring with limited force and torque, evaluated in each substep.

use glam::{DMat3, DQuat, DVec3};

use crate::actuator::limits;
use crate::actuator::work::Work;
use crate::body::{Bodies, BodyForce, Shapes, rotated, rotation_between};
use crate::body_id::BodyId;
use crate::constants::{HAND_LIFT, HAND_RATE, HAND_ROTATION_RATE};
use crate::input::{Grip, Hand};
use crate::report::HandReport;

/// Controller of a hand between two syncs.
#[derive(Debug, Clone)]
pub struct HandController {
    body: usize,
    grip: Grip,
    /// From the body's centre to the grasp point, m.
    arm: DVec3,
    /// From the grasp point to the target, m.
    lead: DVec3,
    /// Velocity of the target, m/s.
    target_velocity: DVec3,
    /// Rotation vector from the body to the target orientation, rad, and its rate, rad/s; none
    /// where the orientation is free.
    rotation: Option<(DVec3, DVec3)>,
    mass: f64,
    inertia: DMat3,
    /// Force that balances gravity, N.
    weight: DVec3,
    /// Share of the weight that the hand carries, N.
    carried: DVec3,
    max_force: f64,
    max_torque: f64,
    /// Force and torque in the last substep.
    pub report: HandReport,
    /// Work on the body.
    pub work: Work,
}

/// Target of a hand: position of the grasp point, and orientation of the body.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct HandTarget {
    /// Body in the hand.
    pub body: BodyId,
    /// Target of the grasp point, m.
    pub target: DVec3,
    /// Target orientation; none leaves it free.
    pub orientation: Option<DQuat>,
}

impl HandTarget {
    /// Target at the moment of grasping: the present pose of the body.
    pub fn at_grasp(hand: &Hand, bodies: &Bodies) -> Self {
        let i = hand.body.index();
        Self {
            body: hand.body,
            target: grasp_point(&hand.anchor, bodies, i),
            orientation: hand.orientation.map(|_| bodies.orientation[i]),
        }
    }

    /// Target at the end of the hand's frame.
    pub fn at_end(hand: &Hand) -> Self {
        Self { body: hand.body, target: hand.target, orientation: hand.orientation }
    }
}

/// Grasp point of body `i` in the world, m.
pub fn grasp_point(anchor: &DVec3, bodies: &Bodies, i: usize) -> DVec3 {
    bodies.position[i] + bodies.orientation[i] * *anchor
}

/// Batch of substeps, as far as it concerns the actuators.
#[derive(Debug, Clone, Copy)]
pub struct BatchTime {
    /// Share of the frame that has passed at the start of the batch.
    pub progress: f64,
    /// Length of the frame, s.
    pub frame: f64,
    /// Gravity in the batch, m/s².
    pub gravity: DVec3,
}

impl HandController {
    /// Controller for a batch. Over the frame the target moves linearly from `from` to that of
    /// `hand`.
    pub fn new(hand: &Hand, from: &HandTarget, batch: &BatchTime, shapes: &Shapes, bodies: &Bodies) -> Self {
        let &BatchTime { progress, frame, gravity } = batch;
        let i = hand.body.index();
        let point = grasp_point(&hand.anchor, bodies, i);
        let rotation = match (from.orientation, hand.orientation) {
            (Some(from), Some(to)) if !matches!(hand.grip, Grip::Push { .. }) => {
                let total = rotation_between(from, to);
                Some((rotation_between(bodies.orientation[i], rotated(from, total * progress)), total / frame))
            }
            _ => None,
        };
        let displacement = hand.target - from.target;
        let weight = -shapes.mass[i] * gravity;
        let share = match hand.grip {
            Grip::Slide if rotation.is_some() => HAND_LIFT,
            Grip::Carry => 1.0,
            Grip::Slide | Grip::Push { .. } => 0.0,
        };
        Self {
            body: i,
            grip: hand.grip,
            arm: point - bodies.position[i],
            lead: from.target + displacement * progress - point,
            target_velocity: displacement / frame,
            rotation,
            mass: shapes.mass[i],
            inertia: bodies.inertia(shapes, i),
            weight,
            carried: share * weight,
            max_force: hand.max_force.min(limits::max_force(shapes, i)),
            max_torque: hand.max_torque.min(limits::max_torque(shapes, i)),
            report: HandReport { point, ..HandReport::default() },
            work: Work::default(),
        }
    }

    /// Index in the cluster of the body in the hand.
    pub fn body(&self) -> usize {
        self.body
    }

    /// Force in a substep of `h` (s) on the body with velocity `v` (m/s) and spin `w` (rad/s).
    pub fn force(&mut self, h: f64, (v, w): (DVec3, DVec3)) -> BodyForce {
        let slip = self.target_velocity - (v + w.cross(self.arm));
        self.lead += slip * h;
        let spring = self.mass * (HAND_RATE * HAND_RATE * self.lead + 2.0 * HAND_RATE * slip);
        let (f, capped) = self.limit_force(spring);
        let mut torque_capped = false;

        let mut torque = DVec3::ZERO;
        if let Some((rotation, rate)) = &mut self.rotation {
            let slip = *rate - w;
            *rotation += slip * h;
            let spring =
                self.inertia * (HAND_ROTATION_RATE * HAND_ROTATION_RATE * *rotation + 2.0 * HAND_ROTATION_RATE * slip);
            // Cancels the moment of the carried weight, which would tip a body grasped off its
            // centre.
            torque = spring - self.arm.cross(self.carried);
            if torque.length() > self.max_torque {
                torque *= self.max_torque / torque.length();
                torque_capped = true;
            }
        }
        self.report = HandReport { force: f, torque, capped, torque_capped, point: self.report.point };
        let force = BodyForce { force: f, arm: self.arm, torque };
        self.work.add(h, force, (v, w));
        force
    }

    /// Limits the force of the spring (N) to what the grip allows; the second result is true if the
    /// limit was reached.
    fn limit_force(&self, spring: DVec3) -> (DVec3, bool) {
        match self.grip {
            Grip::Slide => {
                let up = self.weight.normalize_or_zero();
                let level = spring - up * spring.dot(up);
                let max_lift = self.weight.length().min(self.max_force);
                let lift = (spring + self.carried).dot(up).clamp(-max_lift, max_lift);
                // Lift counts towards the largest force.
                let max_level = (self.max_force * self.max_force - lift * lift).sqrt();
                let size = level.length();
                let capped = size > max_level;
                let level = if capped { level * (max_level / size) } else { level };
                (level + up * lift, capped)
            }
            Grip::Carry => {
                let size = spring.length();
                let capped = size > self.max_force;
                let spring = if capped { spring * (self.max_force / size) } else { spring };
                (spring + self.carried, capped)
            }
            Grip::Push { axis } => {
                let size = spring.dot(axis);
                (axis * size.clamp(0.0, self.max_force), size > self.max_force)
            }
        }
    }
}
