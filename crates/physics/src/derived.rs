//! Quantities derived once from scene and parameters: substep, damping, and constants of all
//! frames.

use glam::DVec3;
use teeter_scene::{Form, Scene};

use crate::body::{Shapes, largest_face};
use crate::constants::{
    CROSSED_MOBILITY, MIN_AREA, NOMINAL_MASS, REFERENCE_AREA, STEP_AREA, STEP_LIMIT, STRAIN_INERTIA,
};
use crate::contact_spring::ContactSpring;
use crate::lattice::springs::Springs;
use crate::params::Params;
use crate::restitution::{Impact, STEP_DAMPING};

/// Quantities that are the same for all bodies and frames of a world.
#[derive(Debug, Clone, Copy)]
pub struct Derived {
    /// Gravity of the scene along -z, m/s².
    pub gravity: f64,
    /// Coefficient of static friction of the floor.
    pub friction: f64,
    /// Kinetic over static friction.
    pub kinetic_ratio: f64,
    /// Damping of contacts, and recovery of their springs.
    pub impact: Impact,
    /// Normal stiffness of a contact of [`REFERENCE_AREA`], N/m.
    pub stiffness: f64,
    /// Springs within the blocks; none for rigid blocks.
    pub springs: Option<Springs>,
    /// Masses that bound the substep.
    pub masses: Masses,
    /// Substep, s.
    pub h: f64,
    /// Substeps of a frame.
    pub substeps: usize,
    /// Length of a frame, s.
    pub frame: f64,
    /// Time over which gravity grows to its full value, s.
    pub ramp: f64,
    /// True if bodies may sleep.
    pub sleep: bool,
}

impl Derived {
    /// Derives all quantities; `masses` are those of the scene's blocks.
    pub fn new(scene: &Scene, params: &Params, masses: Masses) -> Self {
        let impact = Impact::new(scene.restitution);
        let springs = (scene.form == Form::Lattice).then(|| Springs::new(scene));
        let mobility = springs.map_or(CROSSED_MOBILITY, |springs| crossed_mobility(springs.inset));
        let contact = step_fraction(impact.zeta.max(STEP_DAMPING), mobility) * (masses.step / scene.stiffness).sqrt();
        let longest = springs.map_or(contact, |springs| contact.min(springs.max_step(masses.min)));
        let substeps = (params.frame / longest).ceil().max(1.0) as usize;
        Self {
            gravity: scene.gravity,
            friction: scene.friction,
            kinetic_ratio: match scene.kinetic_friction {
                Some(kinetic) if scene.friction > 0.0 => kinetic / scene.friction,
                _ => 1.0,
            },
            impact,
            stiffness: scene.stiffness,
            springs,
            masses,
            h: params.frame / substeps as f64,
            substeps,
            frame: params.frame,
            ramp: params.ramp,
            sleep: params.sleep,
        }
    }

    /// Constants of the springs of contacts.
    pub fn contact_spring(&self) -> ContactSpring {
        ContactSpring { stiffness: self.stiffness, zeta: self.impact.zeta, h: self.h, gravity: self.gravity }
    }

    /// Gravity of the scene, m/s².
    pub fn scene_gravity(&self) -> DVec3 {
        DVec3::new(0.0, 0.0, -self.gravity)
    }
}

/// Longest stable substep times sqrt(k / m) at a damping ratio, from 0.14 to 0.20 for rigid blocks.
///
/// It solves 2 k X h² + 2 c X h = [`STEP_LIMIT`] with X m = `mobility` and
/// c = 2 zeta sqrt(k m / 2), for nominal blocks that cross at their ends.
/// [`crate::kernel::packing`] has the condition.
fn step_fraction(zeta: f64, mobility: f64) -> f64 {
    let spring = 2.0 * mobility;
    let damper = 2.0 * mobility * zeta * std::f64::consts::SQRT_2;
    ((damper * damper + 4.0 * spring * STEP_LIMIT).sqrt() - damper) / (2.0 * spring)
}

/// [`CROSSED_MOBILITY`] of blocks whose particles are at `inset` of the half edges: 2 X m, where X
/// m is 1 + d² m / I for the block as a whole and 1 + Σ l² / g² for its particles.
///
/// Only the difference of the two comes from strain. d = 27.1 mm, l = (27.1, 0, 9) mm, and g are
/// the distances of the particles from the centre.
fn crossed_mobility(inset: f64) -> f64 {
    let (along, up) = (0.0271, 0.009);
    let (far, high) = (0.0405 * inset, 0.009 * inset);
    let rigid = 1.0 + along * along / (far * far + high * high);
    let affine = 1.0 + along * along / (far * far) + up * up / (high * high);
    2.0 * (rigid + (affine - rigid) / STRAIN_INERTIA)
}

/// Masses that bound the substep, kg.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Masses {
    /// Mass that bounds the substep of contacts: that of the nominal block, or less, see
    /// [`step_masses`].
    pub step: f64,
    /// Mass of the lightest body, or of the nominal block.
    pub min: f64,
}

impl Masses {
    /// Masses of a set of bodies, of which those that are fixed do not move.
    pub fn new(shapes: &Shapes, fixed: &[bool]) -> Self {
        let moving = |masses: Vec<f64>| {
            masses.into_iter().zip(fixed).filter(|&(_, &fixed)| !fixed).map(|(m, _)| m).fold(NOMINAL_MASS, f64::min)
        };
        Self { step: moving(step_masses(shapes)), min: moving(shapes.mass.clone()) }
    }
}

/// Masses that bound the substep of contacts, kg: those of the bodies for the stiffness of their
/// largest faces. The nominal block has a third to spare, so a block of the lightest wood does not
/// shorten the step.
fn step_masses(shapes: &Shapes) -> Vec<f64> {
    let spare = 0.75;
    let flat = 0.081 * 0.0268 / REFERENCE_AREA;
    let bounds =
        shapes.half.iter().zip(&shapes.mass).map(|(half, mass)| {
            mass * flat / (largest_face(*half) / REFERENCE_AREA).clamp(MIN_AREA, STEP_AREA) / spare
        });
    bounds.collect()
}
