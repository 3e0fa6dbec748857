//! What a scene must satisfy before a world is built from it.

use crate::overlap;
use crate::{Scene, SceneError};

/// Most blocks of a scene.
pub const MAX_BLOCKS: usize = 20_000;
/// Least and greatest stiffness of a scene, N/m.
pub const STIFFNESS: (f64, f64) = (1e4, 1e8);
/// Least and greatest stiffness of the springs within a block, N/m: jelly, and twice the stiffness of wood across the grain.
pub const SPRING_STIFFNESS: (f64, f64) = (1e3, 1e8);
/// Least and greatest damping ratio of these springs.
pub const SPRING_DAMPING: (f64, f64) = (0.01, 0.5);
/// Shortest and longest edge of a block, m.
const EDGE: (f64, f64) = (1e-3, 10.0);
/// Heaviest block, kg.
const MAX_MASS: f64 = 1e4;
/// Furthest from the origin that a block may be along any axis, m.
const MAX_COORDINATE: f64 = 1e3;
/// Deepest that a block may be inside another or the floor at the start, m. Above the rounding of files that give a few digits.
pub(crate) const MAX_OVERLAP: f64 = 1e-6;

impl Scene {
    /// Checks everything that can be checked without physics; the first fault found is the error.
    pub fn validate(&self) -> Result<(), SceneError> {
        self.validate_constants()?;
        self.validate_blocks()?;
        self.validate_ids()?;
        match overlap::first(&self.blocks, MAX_OVERLAP) {
            Some((i, j, depth)) => {
                Err(SceneError::Overlap { a: self.blocks[i].id, b: self.blocks[j].id, depth_mm: depth * 1e3 })
            }
            None => Ok(()),
        }
    }

    /// The same for all but the blocks.
    pub fn validate_constants(&self) -> Result<(), SceneError> {
        range("gravity", self.gravity, 0.0, 100.0, " m/s²")?;
        range("friction", self.friction, 0.0, 2.0, "")?;
        if let Some(kinetic) = self.kinetic_friction {
            range("kinetic_friction", kinetic, 0.0, 2.0, "")?;
            if kinetic > self.friction {
                let expected = format!("at most `friction`, {}", self.friction);
                return Err(SceneError::Field { field: "kinetic_friction", value: kinetic.to_string(), expected });
            }
        }
        range("restitution", self.restitution, 0.0, 1.0, "")?;
        stiffness("stiffness", self.stiffness, STIFFNESS)?;
        stiffness("springs.stiffness", self.spring_stiffness(), SPRING_STIFFNESS)?;
        range("springs.damping", self.springs.damping, SPRING_DAMPING.0, SPRING_DAMPING.1, "")?;
        if let Some(az) = self.tilt_az {
            range("tilt_az", az, -100.0, 100.0, " rad")?;
        }
        if let Some(label) = &self.label
            && label != "stable"
            && label != "unstable"
        {
            let expected = "`stable` or `unstable`".to_owned();
            return Err(SceneError::Field { field: "label", value: format!("{label:?}"), expected });
        }
        Ok(())
    }

    fn validate_blocks(&self) -> Result<(), SceneError> {
        if !(1..=MAX_BLOCKS).contains(&self.blocks.len()) {
            let value = format!("a list of {}", self.blocks.len());
            return Err(SceneError::Field { field: "blocks", value, expected: format!("1 to {MAX_BLOCKS} blocks") });
        }
        for b in &self.blocks {
            let bad =
                |field, value: String, expected: String| Err(SceneError::Block { id: b.id, field, value, expected });
            if !b.size.iter().all(|l| (EDGE.0..=EDGE.1).contains(l)) {
                return bad("size", triple(b.size), format!("three lengths of {} to {} m", EDGE.0, EDGE.1));
            }
            if !(b.mass > 0.0 && b.mass <= MAX_MASS) {
                return bad("mass", format!("{} kg", b.mass), format!("above 0 and at most {MAX_MASS} kg"));
            }
            if !b.pos.iter().all(|x| x.abs() <= MAX_COORDINATE) {
                return bad("pos", triple(b.pos), format!("three coordinates within {MAX_COORDINATE} m of the origin"));
            }
            if !b.yaw.is_finite() {
                return bad("yaw", b.yaw.to_string(), "a finite angle in rad".into());
            }
            if b.pos[2] - b.size[2] / 2.0 < -MAX_OVERLAP {
                let value = format!("{:.3} mm above the floor at its centre", b.pos[2] * 1e3);
                return bad("pos", value, format!("at least half its height, {:.3} mm", b.size[2] * 500.0));
            }
        }
        Ok(())
    }

    fn validate_ids(&self) -> Result<(), SceneError> {
        let mut places: Vec<(u32, usize)> = self.blocks.iter().enumerate().map(|(i, b)| (b.id, i)).collect();
        places.sort_unstable();
        match places.windows(2).find(|w| w[0].0 == w[1].0) {
            Some(w) => Err(SceneError::DuplicateId { id: w[0].0, first: w[0].1, second: w[1].1 }),
            None => Ok(()),
        }
    }
}

fn range(field: &'static str, value: f64, low: f64, high: f64, unit: &str) -> Result<(), SceneError> {
    if (low..=high).contains(&value) {
        return Ok(());
    }
    Err(SceneError::Field { field, value: value.to_string(), expected: format!("{low} to {high}{unit}") })
}

fn stiffness(field: &'static str, value: f64, (low, high): (f64, f64)) -> Result<(), SceneError> {
    if (low..=high).contains(&value) {
        return Ok(());
    }
    Err(SceneError::Field { field, value: value.to_string(), expected: format!("{low:e} to {high:e} N/m") })
}

fn triple(v: [f64; 3]) -> String {
    format!("[{}, {}, {}] m", v[0], v[1], v[2])
}
