//! Constants of the simulator (section 5.5.1), all of which an ini file can set: see the table.
//! Lengths in m, masses in kg, times in s.

use super::integrate::Scheme;
use super::options::{Culling, Disabling, HandMode, Method, Order, SpringSet};
use super::response::Law;
use super::static_friction::Coefficients;

/// Constants of a run: everything except the tower.
///
/// ```
/// use teeter_dissertation::jenga3d::Constants;
///
/// let soft = Constants { stiffness: 1e3, ..Constants::default() };
/// assert_eq!(soft.step(), 1.0 / 9600.0);
/// assert_eq!(Constants::from_ini("[Springs]\nstiffness = 1e3"), Ok(soft));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Constants {
    /// Frames per second of simulated time, 1/s.
    pub frame_rate: f64,
    /// Steps of integrating, colliding and accepting in a frame (`midLoopCount` of Figure 5.2). A
    /// step detects a contact once, so it must be short against the period of a corner on its
    /// springs.
    pub mid_loop_count: u32,
    /// Acceleration of gravity along -z, m/s².
    pub gravity: f64,
    /// Distance between rows at the start, m: they fall onto each other (section 5.2.1).
    pub row_spacing: f64,
    /// Integrator.
    pub method: Method,
    /// Steps of the multi-step Euler method in one of the `mid_loop_count` steps
    /// (`iterationsPerFrame` of appendix 2.1).
    pub iterations_per_frame: u32,
    /// Springs of a block.
    pub springs: SpringSet,
    /// Stiffness of every spring, N/m. A block is about six times as stiff along each of its axes.
    pub stiffness: f64,
    /// Damping of every spring, N s/m.
    pub damping: f64,
    /// Ratio of the speeds after and before a collision, 0 to 1 (Eq. 2.11). At 0 only rounding
    /// separates blocks at rest.
    pub restitution: f64,
    /// True for contacts with friction.
    pub friction_enabled: bool,
    /// Coefficient of kinetic friction (Eq. 2.18).
    pub friction: f64,
    /// Drag of a contact across its normal, N s/m.
    pub drag: f64,
    /// Coefficient of static friction; `None` is the method of 2003, which has only kinetic
    /// friction.
    pub static_friction: Option<f64>,
    /// Enlargement of faces and edges, m: enough that rounding leaves no gap between the triangles
    /// of a side.
    pub tolerance: f64,
    /// Maximum number of rounds over the pairs in one call of `CollideBlocks`. A call with
    /// collisions left is counted.
    pub max_sweeps: u32,
    /// Order of the pairs.
    pub order: Order,
    /// Tests before the exact one.
    pub culling: Culling,
    /// True to compare the boxes of corners and faces as Figure 5.5 lists it.
    ///
    /// Its first inner loop iterates over the corners p1 of the first block and the faces f2 of the
    /// second, but compares p2 with f1. Every corner then remains for each face that overlaps the
    /// other block: more tests, which find only corners that miss a face by less than `tolerance`.
    pub listed_boxes: bool,
    /// True to skip pairs whose blocks have not changed since their last test within a step. It
    /// saves tests and changes no result.
    pub skip_unchanged: bool,
    /// Disabling of blocks.
    pub disabling: Disabling,
    /// Threshold of disabling, m, for the sum of the distances that a block's eight particles move
    /// in one step (appendix 2.5). The threshold of 2e-4 there has no unit and belongs to an
    /// unknown time step.
    pub disable_threshold: f64,
    /// Impulse of a collision that enables a disabled block, N s (section 4.7).
    pub reactivation_impulse: f64,
    /// Time over which [`Disabling::Rigid`] compares the poses of a block, s.
    pub rest_time: f64,
    /// Maximum displacement of a corner by the rigid motion of a resting block within that time, m.
    pub rest_distance: f64,
    /// Method of the hand.
    pub hand: HandMode,
    /// Force of the hand per distance between block and target, N/m.
    pub hand_stiffness: f64,
    /// Velocity written by the hand per distance between block and target, 1/s.
    pub hand_rate: f64,
    /// Steps after the last collision during which a block counts as in contact. A block at rest
    /// collides once in several steps.
    pub contact_memory: u32,
}

impl Default for Constants {
    fn default() -> Self {
        Self {
            frame_rate: 60.0,
            mid_loop_count: 160,
            gravity: 9.81,
            row_spacing: 1e-4,
            method: Method::Multi,
            iterations_per_frame: 2,
            springs: SpringSet::All,
            stiffness: 1e4,
            damping: 2.0,
            restitution: 0.1,
            friction_enabled: true,
            friction: 0.4,
            drag: 0.05,
            static_friction: None,
            tolerance: 1e-7,
            max_sweeps: 8,
            order: Order::Naive,
            culling: Culling::Planes,
            listed_boxes: false,
            skip_unchanged: true,
            disabling: Disabling::Listed,
            disable_threshold: 5e-6,
            reactivation_impulse: 2e-3,
            rest_time: 0.25,
            rest_distance: 1e-4,
            hand: HandMode::Hybrid,
            hand_stiffness: 40.0,
            hand_rate: 20.0,
            contact_memory: 16,
        }
    }
}

impl Constants {
    /// Time of one step of integrating and colliding, s.
    pub fn step(&self) -> f64 {
        1.0 / (self.frame_rate * f64::from(self.mid_loop_count))
    }

    /// Law of collisions.
    pub fn law(&self) -> Law {
        let friction = self.static_friction.filter(|_| self.friction_enabled);
        Law {
            restitution: self.restitution,
            friction: friction.map(|static_friction| Coefficients { static_friction, kinetic_friction: self.friction }),
        }
    }

    /// Integration scheme of a step.
    pub fn scheme(&self) -> Scheme {
        Scheme { method: self.method, steps: self.iterations_per_frame, time: self.step() }
    }

    /// Time between two computations of forces, s.
    pub fn force_step(&self) -> f64 {
        match self.method {
            Method::Multi => self.step() / f64::from(self.iterations_per_frame),
            _ => self.step(),
        }
    }
}
