//! What acts on a world from outside during one step.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

/// What acts on a world from outside during one step.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Input {
    /// Gravity, m/s²; the scene's where absent.
    pub gravity: Option<DVec3>,
    /// The player's hand.
    pub hand: Option<Hand>,
    /// Constant forces.
    pub forces: Vec<AppliedForce>,
    /// Bodies moved with a given velocity by a strong arm: for experiments, not for play.
    pub drives: Vec<Drive>,
}

/// How a hand holds a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Grip {
    /// Fingers on a block in the tower: they steer it sideways, keep its orientation and take half of its weight off what bears it, where they hold an orientation;
    /// upwards they give no more than the block's own weight, so they cannot lift the tower.
    Slide,
    /// A block in the air: moved in all directions, its weight carried.
    Carry,
    /// One fingertip: pushes along `axis`, never pulls, and holds no orientation.
    Push,
}

/// A hand: a critically damped spring between a point of a body and a target, with limited force and torque.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Hand {
    /// Index of the body it holds.
    pub body: u32,
    /// The point that was grasped, in the body's frame, m.
    pub anchor: DVec3,
    /// Where that point is wanted at the end of the step, m. The target moves there evenly from where it was at the end of the last step.
    pub target: DVec3,
    /// Orientation wanted for the body (x, y, z, w), reached in the same way; none leaves it free.
    #[serde(default)]
    pub orientation: Option<DQuat>,
    /// How it holds.
    pub grip: Grip,
    /// Direction of a push, unit vector in the world; only [`Grip::Push`] reads it.
    #[serde(default)]
    pub axis: DVec3,
    /// Largest force, N.
    #[serde(default = "Hand::default_force")]
    pub max_force: f64,
    /// Largest torque, N m.
    #[serde(default = "Hand::default_torque")]
    pub max_torque: f64,
}

impl Hand {
    /// Force of a careful hand, N: below it a tower of 10 N can only be tipped near its top.
    pub fn default_force() -> f64 {
        4.0
    }

    /// Torque of a careful hand, N m: twice what holds a block level by its end.
    pub fn default_torque() -> f64 {
        0.02
    }
}

/// A force at a point that moves with a body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AppliedForce {
    /// Index of the body.
    pub body: u32,
    /// Point of attack in the body's frame, m.
    #[serde(default)]
    pub point: DVec3,
    /// Force in the world at the end of the step, N; it grows evenly from that of the last step.
    pub force: DVec3,
}

/// A velocity that a strong arm gives a body during one step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Drive {
    /// Index of the body.
    pub body: u32,
    /// Velocity of its centre, m/s; it is kept from turning.
    pub velocity: DVec3,
    /// Largest force, N.
    #[serde(default = "Drive::default_force")]
    pub max_force: f64,
}

impl Drive {
    /// Force of a strong arm, N: a hundred tight blocks.
    pub fn default_force() -> f64 {
        100.0
    }
}
