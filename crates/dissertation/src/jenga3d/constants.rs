//! The constants of the simulator (section 5.5.1), all of which an ini file can set. Lengths in m, masses in kg, times in s.

use super::collide::{Culling, Order};
use super::disable::Disabling;
use super::hand::HandMode;
use super::integrate::Method;
use super::response::Law;
use super::static_friction::Coefficients;

/// Everything about a run that is not the tower.
#[derive(Debug, Clone, PartialEq)]
pub struct Constants {
    /// Frames in a second of simulated time.
    pub frame_rate: f64,
    /// Times that a frame integrates, collides and accepts (`midLoopCount` of Figure 5.2). A contact is only seen once in each, so the time
    /// of one must be short against the period of a corner on its springs.
    pub mid_loop_count: u32,
    /// Acceleration of gravity along -z, m/s².
    pub gravity: f64,
    /// How far apart the rows are at the start, m: they fall onto each other (section 5.2.1).
    pub row_spacing: f64,
    /// How states are stepped forward.
    pub method: Method,
    /// Steps of the multi-step Euler method in each of a frame's `mid_loop_count` (`iterationsPerFrame` of appendix 2.1).
    pub iterations_per_frame: u32,
    /// Of every spring, N/m. A block is some six times as stiff along each of its axes.
    pub stiffness: f64,
    /// Of every spring, N s/m.
    pub damping: f64,
    /// Ratio of the speeds after and before a collision, 0 to 1 (Eq. 2.11). Zero leaves no gap between blocks at rest but rounding.
    pub restitution: f64,
    /// Whether there is friction.
    pub friction_enabled: bool,
    /// Coefficient of kinetic friction (Eq. 2.18).
    pub friction: f64,
    /// Drag of a contact across its normal, N s/m.
    pub drag: f64,
    /// Coefficient of static friction where it is modelled; none is the 2003 method.
    pub static_friction: Option<f64>,
    /// By how much faces and edges count as larger, m: enough that rounding leaves no gap between the triangles of a side.
    pub tolerance: f64,
    /// Most rounds over the pairs in one call of `CollideBlocks`; what is not resolved by then is counted.
    pub max_sweeps: u32,
    /// Order in which pairs are looked at.
    pub order: Order,
    /// Which tests come before the exact one.
    pub culling: Culling,
    /// Whether the boxes of corners and faces are compared as Figure 5.5 lists it: its first inner loop goes over the corners p1 of the first
    /// block and the faces f2 of the second, but compares p2 with f1, which says nothing of the two at hand, so that every corner is left
    /// for each face that meets the other block. It costs tests, and finds no more than corners that pass a face by less than `tolerance`.
    pub listed_boxes: bool,
    /// Whether pairs neither of whose blocks has changed are passed over within a step. It saves tests and changes no result.
    pub skip_unchanged: bool,
    /// How blocks are disabled.
    pub disabling: Disabling,
    /// A block is disabled when the ways of its eight particles in one step sum up to less, m (appendix 2.5). The threshold of 2e-4 there has
    /// no unit, and belongs to a time step that is not told.
    pub disable_threshold: f64,
    /// Impulse at which a collision enables a disabled block, N s (section 4.7).
    pub reactivation_impulse: f64,
    /// Time over which [`Disabling::Rigid`] watches a block, s.
    pub rest_time: f64,
    /// How far a corner may come by the rigid motion of its block within that time, m.
    pub rest_distance: f64,
    /// How the hand moves a block.
    pub hand: HandMode,
    /// Force of the hand per distance between block and target, N/m.
    pub hand_stiffness: f64,
    /// Velocity that the hand gives per distance between block and target, 1/s.
    pub hand_rate: f64,
    /// Steps after the last collision for which a block counts as in contact: at rest it collides in one of several.
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
    /// Time of one round of integrating and colliding, s.
    pub fn step(&self) -> f64 {
        1.0 / (self.frame_rate * f64::from(self.mid_loop_count))
    }

    /// How a collision goes.
    pub fn law(&self) -> Law {
        let friction = self.static_friction.filter(|_| self.friction_enabled);
        Law {
            restitution: self.restitution,
            friction: friction.map(|at_rest| Coefficients { at_rest, sliding: self.friction }),
        }
    }

    /// Time between two computations of forces, s.
    pub fn force_step(&self) -> f64 {
        match self.method {
            Method::Multi => self.step() / f64::from(self.iterations_per_frame),
            _ => self.step(),
        }
    }
}
