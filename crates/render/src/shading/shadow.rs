//! Shadow of the sun: a disc in the sky, so that shadows are sharp near the block that casts them
//! and soft far from it.

use glam::Vec3;

use super::noise::random;
use crate::ray::Ray;
use crate::solids::Solids;

/// Radius of the sun's disc over its distance.
const RADIUS: f32 = 0.0425;
/// Fraction of the sun's light that a shadow takes.
const INTENSITY: f32 = 0.92;
/// Distances along the normal and towards the sun at which a ray begins, m. They lift it out of the
/// groove between two blocks, whose chamfers then catch the light as on the page.
const LIFT: f32 = 0.0009;
const BIAS: f32 = 0.0007;
/// Directions that find the edge of a shadow, and those that are averaged there.
const PROBES: u32 = 12;
const SAMPLES: u32 = 96;
/// Angle between consecutive samples on a spiral that covers a disc evenly, rad.
const GOLDEN_ANGLE: f32 = 2.399_963_2;

/// Fixed pattern of directions to the sun.
#[derive(Debug)]
pub struct SunDisc {
    /// Unit vector to the middle of the disc.
    direction: Vec3,
    probes: Vec<Vec3>,
    samples: Vec<Vec3>,
}

impl SunDisc {
    /// Returns the directions to a sun in a direction of unit length.
    pub fn new(direction: Vec3) -> Self {
        let a = direction.any_orthonormal_vector();
        let b = direction.cross(a);
        let spiral = |count: u32, turn: f32| {
            let sample = |i: u32| {
                let radius = RADIUS * ((i as f32 + 0.5) / count as f32).sqrt();
                let (sin, cos) = libm::sincosf(turn + GOLDEN_ANGLE * i as f32);
                (direction + radius * (cos * a + sin * b)).normalize()
            };
            (0..count).map(sample).collect()
        };
        Self { direction, probes: spiral(PROBES, 0.0), samples: spiral(SAMPLES, random(0, 0)) }
    }

    /// Returns the fraction of the sun's light that arrives at a point of a surface.
    pub fn light(&self, solids: &Solids, point: Vec3, normal: Vec3) -> f32 {
        let origin = point + LIFT * normal + BIAS * self.direction;
        let count = |directions: &[Vec3]| {
            let lit = |&&direction: &&Vec3| !solids.is_blocked(&Ray { origin, direction });
            directions.iter().filter(lit).count()
        };
        let probed = count(&self.probes);
        let visible = match probed {
            0 => 0.0,
            n if n == self.probes.len() => 1.0,
            n => (n + count(&self.samples)) as f32 / (self.probes.len() + self.samples.len()) as f32,
        };
        1.0 - INTENSITY * (1.0 - visible)
    }
}
