//! The hand: a critically damped spring with limited force and torque, evaluated in each substep.

use glam::{DMat3, DQuat, DVec3};

use crate::body::{Bodies, Shapes, turn, turned};
use crate::constants::{HAND_LIFT, HAND_RATE, HAND_TURN_RATE};
use crate::form::Push;
use crate::input::{Grip, Hand};
use crate::report::HandReport;

/// A hand between two syncs.
#[derive(Debug, Clone)]
pub struct Pull {
    row: usize,
    grip: Grip,
    /// From the centre to the grasped point, m.
    arm: DVec3,
    /// From the grasped point to the target, m, and the target's velocity, m/s.
    lead: DVec3,
    target_velocity: DVec3,
    /// Rotation vector from the body to the wanted orientation, rad, and its rate, rad/s; absent where the orientation is free.
    twist: Option<(DVec3, DVec3)>,
    mass: f64,
    inertia: DMat3,
    /// What holds the body against gravity, N, and the share of it that the hand takes upon itself.
    weight: DVec3,
    carried: DVec3,
    max_force: f64,
    max_torque: f64,
    /// What it did in the last substep.
    pub report: HandReport,
}

/// Where a hand wants its body: the target of the grasped point and the orientation.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Aim {
    /// The body held.
    pub body: u32,
    /// Target of the grasped point, m.
    pub target: DVec3,
    /// Orientation wanted.
    pub orientation: Option<DQuat>,
}

impl Aim {
    /// Where a hand that has just taken hold wants its body: where it is.
    pub fn of_grasp(hand: &Hand, bodies: &Bodies) -> Self {
        let i = hand.body.index();
        Self {
            body: hand.body.0,
            target: grasped(&hand.anchor, bodies, i),
            orientation: hand.orientation.map(|_| bodies.orientation[i]),
        }
    }

    /// Where a hand wants its body at the end of its frame.
    pub fn of(hand: &Hand) -> Self {
        Self { body: hand.body.0, target: hand.target, orientation: hand.orientation }
    }
}

/// The point of body `i` that was grasped, in the world, m.
pub fn grasped(anchor: &DVec3, bodies: &Bodies, i: usize) -> DVec3 {
    bodies.position[i] + bodies.orientation[i] * *anchor
}

impl Pull {
    /// The hand for a batch that starts when the share `done` of a frame of `frame` (s) is over; over the frame the aim moves
    /// evenly from `from` to that of `hand`.
    pub fn new(
        hand: &Hand,
        from: &Aim,
        done: f64,
        frame: f64,
        gravity: DVec3,
        shapes: &Shapes,
        bodies: &Bodies,
    ) -> Self {
        let i = hand.body.index();
        let point = grasped(&hand.anchor, bodies, i);
        let twist = match (from.orientation, hand.orientation) {
            (Some(from), Some(to)) if !matches!(hand.grip, Grip::Push { .. }) => {
                let whole = turn(from, to);
                Some((turn(bodies.orientation[i], turned(from, whole * done)), whole / frame))
            }
            _ => None,
        };
        let way = hand.target - from.target;
        let weight = -shapes.mass[i] * gravity;
        let share = match hand.grip {
            Grip::Slide if twist.is_some() => HAND_LIFT,
            Grip::Carry => 1.0,
            Grip::Slide | Grip::Push { .. } => 0.0,
        };
        Self {
            row: i,
            grip: hand.grip,
            arm: point - bodies.position[i],
            lead: from.target + way * done - point,
            target_velocity: way / frame,
            twist,
            mass: shapes.mass[i],
            inertia: bodies.inertia(shapes, i),
            weight,
            carried: share * weight,
            max_force: hand.max_force,
            max_torque: hand.max_torque,
            report: HandReport { point, ..HandReport::default() },
        }
    }

    /// Index of the body held.
    pub fn body(&self) -> usize {
        self.row
    }

    /// What it does in a substep of `h` (s) to a body of this velocity and spin.
    pub fn force(&mut self, h: f64, (v, w): (DVec3, DVec3)) -> Push {
        let slip = self.target_velocity - (v + w.cross(self.arm));
        self.lead += slip * h;
        let spring = self.mass * (HAND_RATE * HAND_RATE * self.lead + 2.0 * HAND_RATE * slip);
        let (f, capped) = self.limited(spring);
        let mut torque_capped = false;

        let mut hold = DVec3::ZERO;
        if let Some((twist, rate)) = &mut self.twist {
            let slip = *rate - w;
            *twist += slip * h;
            let spring = self.inertia * (HAND_TURN_RATE * HAND_TURN_RATE * *twist + 2.0 * HAND_TURN_RATE * slip);
            // what is carried by one end must not tip for it
            hold = spring - self.arm.cross(self.carried);
            if hold.length() > self.max_torque {
                hold *= self.max_torque / hold.length();
                torque_capped = true;
            }
        }
        self.report = HandReport { force: f, torque: hold, capped, torque_capped, point: self.report.point };
        Push { force: f, arm: self.arm, torque: hold }
    }

    /// The force that the grip allows of what the spring wants, and whether that is less.
    fn limited(&self, spring: DVec3) -> (DVec3, bool) {
        match self.grip {
            Grip::Slide => {
                let up = self.weight.normalize_or_zero();
                let level = spring - up * spring.dot(up);
                let highest = self.weight.length().min(self.max_force);
                let lift = (spring + self.carried).dot(up).clamp(-highest, highest);
                // what it lifts is part of its force
                let most = (self.max_force * self.max_force - lift * lift).sqrt();
                let size = level.length();
                let capped = size > most;
                let level = if capped { level * (most / size) } else { level };
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
