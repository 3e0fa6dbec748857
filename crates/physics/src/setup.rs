//! What is the same for all bodies and frames of a world.

use glam::DVec3;
use teeter_scene::{Form, Scene};

use crate::body::Shapes;
use crate::constants::{
    AREA_RANGE, CROSSED_MOBILITY, MAXWELL_TIME, NOMINAL_MASS, REFERENCE_AREA, STEP_LIMIT, STRIBECK_SPEED,
    TANGENTIAL_DAMPING, TANGENTIAL_STIFFNESS,
};
use crate::kernel::Law;
use crate::lattice::{STRAIN_INERTIA, Springs};
use crate::params::Params;
use crate::restitution::damping_ratio;
use crate::simd::lanes::Real;

/// What is the same for all bodies and frames of a world.
#[derive(Debug, Clone, Copy)]
pub struct Setup {
    /// Gravity of the scene along -z, m/s².
    pub gravity: f64,
    /// Static and kinetic friction.
    pub mu: (f64, f64),
    /// Damping ratio.
    pub zeta: f64,
    /// Normal stiffness of a contact of the reference area, N/m.
    pub stiffness: f64,
    /// The springs within the blocks; none where they are rigid.
    pub springs: Option<Springs>,
    /// What of the bodies bounds the substep.
    pub masses: Masses,
    /// Substep, s, and how many make a frame.
    pub h: f64,
    pub substeps: usize,
    /// Time that a frame covers, s.
    pub frame: f64,
    /// Time over which gravity grows, s.
    pub ramp: f64,
    /// Whether bodies may sleep.
    pub sleep: bool,
}

impl Setup {
    pub fn new(scene: &Scene, params: &Params, masses: Masses) -> Self {
        let zeta = damping_ratio(scene.restitution);
        let springs = (scene.form == Form::Lattice).then(|| Springs::new(scene));
        let mobility =
            if springs.is_some() { crossed_mobility(scene.springs.particles.inset()) } else { CROSSED_MOBILITY };
        let contact = step_fraction(zeta, mobility) * (masses.step / scene.stiffness).sqrt();
        let longest = springs.map_or(contact, |springs| contact.min(springs.longest_step(masses.least)));
        let substeps = (params.frame / longest).ceil().max(1.0) as usize;
        Self {
            gravity: scene.gravity,
            mu: (scene.friction, scene.kinetic_friction.unwrap_or(scene.friction)),
            zeta,
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

    /// Gravity of the scene, m/s².
    pub fn own_gravity(&self) -> DVec3 {
        DVec3::new(0.0, 0.0, -self.gravity)
    }

    /// The constants of the inner loop.
    pub fn law<R: Real>(&self) -> Law<R> {
        let way = self.h * STRIBECK_SPEED;
        Law {
            keep: R::from_f64(1.0 - self.h / MAXWELL_TIME),
            tangential: R::from_f64(TANGENTIAL_STIFFNESS),
            tangential_relaxation: R::from_f64(TANGENTIAL_DAMPING / TANGENTIAL_STIFFNESS),
            mu_kinetic: R::from_f64(self.mu.1),
            mu_excess: R::from_f64(self.mu.0 - self.mu.1),
            stribeck: R::from_f64(1.0 / (way * way)),
        }
    }
}

/// The substep times sqrt(k / m) that a damping ratio allows: where 2 k X h² + 2 c X h = [`STEP_LIMIT`] for the contact of
/// nominal blocks that cross at their ends, of which X m is `mobility`, with c = 2 zeta sqrt(k m / 2). See [`crate::pack`] for the
/// condition. From 0.14 to 0.20 for rigid blocks.
fn step_fraction(zeta: f64, mobility: f64) -> f64 {
    let spring = 2.0 * mobility;
    let damper = 2.0 * mobility * zeta * std::f64::consts::SQRT_2;
    ((damper * damper + 4.0 * spring * STEP_LIMIT).sqrt() - damper) / (2.0 * spring)
}

/// [`CROSSED_MOBILITY`] for blocks of particles at `place` of the half edges: 2 X m, where X m is 1 + d² m / I for the block as a whole and
/// 1 + Σ l² / g² for its particles, of which only a part comes from straining; d = 27.1 mm, l = (27.1, 0, 9) mm, and g are the distances of the
/// particles from the centre.
fn crossed_mobility(place: f64) -> f64 {
    let (along, up) = (0.0271, 0.009);
    let (far, high) = (0.0405 * place, 0.009 * place);
    let rigid = 1.0 + along * along / (far * far + high * high);
    let affine = 1.0 + along * along / (far * far) + up * up / (high * high);
    2.0 * (rigid + (affine - rigid) / STRAIN_INERTIA)
}

/// The masses that bound the substep, kg.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Masses {
    /// For contacts: that of the nominal block, or what counts as less.
    pub step: f64,
    /// Of the lightest body.
    pub least: f64,
}

impl Masses {
    pub fn new(shapes: &Shapes) -> Self {
        Self { step: step_mass(shapes), least: shapes.mass.iter().copied().fold(f64::INFINITY, f64::min) }
    }
}

/// The mass that bounds the substep, kg: that of the lightest body for the stiffness of its largest face. The nominal block has a
/// third to spare, so a block of the lightest wood does not shorten the step.
fn step_mass(shapes: &Shapes) -> f64 {
    let spare = 0.75;
    let flat = 0.081 * 0.0268 / REFERENCE_AREA;
    let bounds = shapes.half.iter().zip(&shapes.mass).map(|(half, mass)| {
        let face = 4.0 * (half.x * half.y).max(half.y * half.z).max(half.z * half.x);
        mass * flat / (face / REFERENCE_AREA).clamp(AREA_RANGE.0, AREA_RANGE.1)
    });
    bounds.map(|m| m / spare).fold(NOMINAL_MASS, f64::min)
}
