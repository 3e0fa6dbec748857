//! Validation of scenes.

use crate::error::SceneError;
use crate::overlap;
use crate::scene::Scene;

/// Maximum number of blocks in a scene.
pub const MAX_BLOCKS: usize = 20_000;
/// Minimum and maximum stiffness of a scene, N/m.
pub const STIFFNESS: (f64, f64) = (1e4, 1e8);
/// Minimum and maximum stiffness of the springs in a block, N/m: jelly, and twice the stiffness of
/// wood across the grain.
pub const SPRING_STIFFNESS: (f64, f64) = (1e3, 1e8);
/// Minimum and maximum damping ratio of the springs in a block.
pub const SPRING_DAMPING: (f64, f64) = (0.01, 0.5);
/// Minimum and maximum edge length of a block, m.
const EDGE: (f64, f64) = (1e-3, 10.0);
/// Maximum mass of a block, kg.
const MAX_MASS: f64 = 1e4;
/// Maximum distance of a block from the origin along any axis, m.
const MAX_COORDINATE: f64 = 1e3;
/// Maximum depth of a block inside another or the floor, m: above the rounding of files that give a
/// few digits.
const MAX_OVERLAP: f64 = 1e-6;

impl Scene {
    /// Checks every field, and that no two blocks overlap.
    ///
    /// # Errors
    /// Names the first invalid field, its value and the expected range.
    ///
    /// ```
    /// let mut scene = teeter_scene::named("block").expect("the list has it");
    /// scene.blocks[0].mass = -1.0;
    /// let error = scene.validate().unwrap_err().to_string();
    /// assert_eq!(error, "block 0: `mass` is -1 kg, expected above 0 and at most 10000 kg");
    /// ```
    pub fn validate(&self) -> Result<(), SceneError> {
        self.validate_constants()?;
        self.validate_blocks()?;
        self.validate_ids()?;
        match overlap::first_pair(&self.blocks, MAX_OVERLAP) {
            Some((i, j, depth)) => {
                Err(SceneError::Overlap { a: self.blocks[i].id, b: self.blocks[j].id, depth_mm: depth * 1e3 })
            }
            None => Ok(()),
        }
    }

    /// Checks every field except the blocks.
    ///
    /// # Errors
    /// As [`Scene::validate`].
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
            let invalid =
                |field, value: String, expected: String| Err(SceneError::Block { id: b.id, field, value, expected });
            if !b.size.iter().all(|l| (EDGE.0..=EDGE.1).contains(l)) {
                return invalid("size", triple(b.size), format!("three lengths of {} to {} m", EDGE.0, EDGE.1));
            }
            if !(b.mass > 0.0 && b.mass <= MAX_MASS) {
                return invalid("mass", format!("{} kg", b.mass), format!("above 0 and at most {MAX_MASS} kg"));
            }
            if !b.pos.iter().all(|x| x.abs() <= MAX_COORDINATE) {
                let expected = format!("three coordinates within {MAX_COORDINATE} m of the origin");
                return invalid("pos", triple(b.pos), expected);
            }
            if !b.yaw.is_finite() {
                return invalid("yaw", b.yaw.to_string(), "a finite angle in rad".into());
            }
            if b.pos[2] - b.size[2] / 2.0 < -MAX_OVERLAP {
                let value = format!("{:.3} mm above the floor at its centre", b.pos[2] * 1e3);
                return invalid("pos", value, format!("at least half its height, {:.3} mm", b.size[2] * 500.0));
            }
        }
        Ok(())
    }

    fn validate_ids(&self) -> Result<(), SceneError> {
        let mut ids: Vec<(u32, usize)> = self.blocks.iter().enumerate().map(|(i, b)| (b.id, i)).collect();
        ids.sort_unstable();
        match ids.windows(2).find(|w| w[0].0 == w[1].0) {
            Some(w) => Err(SceneError::DuplicateId { id: w[0].0, first: w[0].1, second: w[1].1 }),
            None => Ok(()),
        }
    }
}

fn range(field: &'static str, value: f64, min: f64, max: f64, unit: &str) -> Result<(), SceneError> {
    if (min..=max).contains(&value) {
        return Ok(());
    }
    Err(SceneError::Field { field, value: value.to_string(), expected: format!("{min} to {max}{unit}") })
}

fn stiffness(field: &'static str, value: f64, (min, max): (f64, f64)) -> Result<(), SceneError> {
    if (min..=max).contains(&value) {
        return Ok(());
    }
    Err(SceneError::Field { field, value: value.to_string(), expected: format!("{min:e} to {max:e} N/m") })
}

fn triple(v: [f64; 3]) -> String {
    format!("[{}, {}, {}] m", v[0], v[1], v[2])
}
