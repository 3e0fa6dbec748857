//! Validation of scenes.

use std::f64::consts::TAU;

use glam::{DQuat, DVec3};

use crate::error::SceneError;
use crate::overlap;
use crate::printable::shown;
use crate::scene::{Block, Scene};

/// Maximum number of blocks in a scene.
pub const MAX_BLOCKS: usize = 20_000;
/// Minimum and maximum stiffness of a scene, N/m.
pub const STIFFNESS: (f64, f64) = (1e4, 1e8);
/// Minimum and maximum stiffness of the springs in a block, N/m: jelly, and twice the stiffness of
/// wood across the grain.
pub const SPRING_STIFFNESS: (f64, f64) = (1e3, 1e8);
/// Minimum and maximum damping ratio of the springs in a block.
pub const SPRING_DAMPING: (f64, f64) = (0.01, 0.5);
/// Minimum and maximum edge length of a block, m: a playing card is 0.3 mm thick.
const EDGE: (f64, f64) = (2e-4, 10.0);
/// Maximum mass of a block, kg.
const MAX_MASS: f64 = 1e4;
/// Maximum distance of a block from the origin along any axis, m.
const MAX_COORDINATE: f64 = 1e3;
/// Maximum speed of a block's centre at the start, and of its corners about the centre, m/s.
const MAX_SPEED: f64 = 100.0;
/// Maximum deviation of a quaternion's length from 1, above the rounding of files that give a few
/// digits.
const MAX_LENGTH_ERROR: f64 = 1e-3;
/// Maximum angle in either direction, rad: two turns, since programs add angles up. A number of
/// degrees is above it from 13 on.
const MAX_ANGLE: f64 = 2.0 * TAU;
/// Maximum depth of a block inside another or the floor, m: above the rounding of files that give
/// positions with five digits after the point.
pub const MAX_OVERLAP: f64 = 2e-5;

impl Scene {
    /// Checks every field, and that no block overlaps another or the floor. Fixed blocks may
    /// overlap each other and the floor.
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
        self.validate_fields()?;
        for b in self.blocks.iter().filter(|b| !b.fixed) {
            self.validate_height(b)?;
        }
        match overlap::first_pair(self, MAX_OVERLAP) {
            Some(pair) => Err(SceneError::Overlap {
                a: self.blocks[pair.first].id,
                b: self.blocks[pair.second].id,
                depth_mm: pair.depth * 1e3,
            }),
            None => Ok(()),
        }
    }

    /// Checks every field by itself: blocks may overlap each other and the floor.
    ///
    /// # Errors
    /// As [`Scene::validate`].
    ///
    /// ```
    /// let mut scene = teeter_scene::named("column").expect("the list has it");
    /// scene.blocks[1].pos[2] -= 0.001;
    /// assert!(scene.validate().is_err());
    /// assert_eq!(scene.validate_fields(), Ok(()));
    /// ```
    pub fn validate_fields(&self) -> Result<(), SceneError> {
        self.validate_constants()?;
        if !(1..=MAX_BLOCKS).contains(&self.blocks.len()) {
            let value = format!("a list of {}", self.blocks.len());
            return Err(SceneError::Field { field: "blocks", value, expected: format!("1 to {MAX_BLOCKS} blocks") });
        }
        self.blocks.iter().try_for_each(validate_block)?;
        self.validate_edge_radius()?;
        self.validate_ids()
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
            angle(String::new(), "tilt_az", az)?;
        }
        if let Some(label) = &self.label
            && label != "stable"
            && label != "unstable"
        {
            let expected = "`stable` or `unstable`".to_owned();
            return Err(SceneError::Field { field: "label", value: format!("\"{}\"", shown(label)), expected });
        }
        Ok(())
    }

    /// Checks that the edges of every block leave a face between them.
    fn validate_edge_radius(&self) -> Result<(), SceneError> {
        let by_edge = |a: &&Block, b: &&Block| a.smallest_edge().total_cmp(&b.smallest_edge());
        let Some(smallest) = self.blocks.iter().min_by(by_edge) else { return Ok(()) };
        let max = smallest.smallest_edge() / 3.0;
        // A third in decimals may be above a third in binary by a rounding.
        if (0.0..=max * (1.0 + 1e-12)).contains(&self.edge_radius) {
            return Ok(());
        }
        let value = format!("{} m", self.edge_radius);
        let expected = format!("0 to {max:.6} m, a third of the smallest edge of block {}", smallest.id);
        Err(SceneError::Field { field: "edge_radius", value, expected })
    }

    /// Checks that a block does not reach into the floor.
    fn validate_height(&self, b: &Block) -> Result<(), SceneError> {
        let lowest = overlap::lowest_point(b, self.edge_radius);
        if lowest >= -MAX_OVERLAP {
            return Ok(());
        }
        let reach = 1e3 * (b.pos[2] - lowest);
        let of_reach = if b.orientation.is_some() {
            "the height of its centre above its lowest corner"
        } else {
            "half its height"
        };
        Err(SceneError::Block {
            id: b.id,
            field: "pos",
            value: format!("{:.3} mm above the floor at its centre", b.pos[2] * 1e3),
            expected: format!("at least {of_reach}, {reach:.3} mm"),
        })
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

/// Checks a block by itself.
fn validate_block(b: &Block) -> Result<(), SceneError> {
    let invalid = |field, value: String, expected: String| Err(SceneError::Block { id: b.id, field, value, expected });
    if !b.size.iter().all(|l| (EDGE.0..=EDGE.1).contains(l)) {
        return invalid("size", list(&b.size, " m"), format!("three lengths of {} to {} m", EDGE.0, EDGE.1));
    }
    if !(b.mass > 0.0 && b.mass <= MAX_MASS) {
        return invalid("mass", format!("{} kg", b.mass), format!("above 0 and at most {MAX_MASS} kg"));
    }
    if !b.pos.iter().all(|x| x.abs() <= MAX_COORDINATE) {
        let expected = format!("three coordinates within {MAX_COORDINATE} m of the origin");
        return invalid("pos", list(&b.pos, " m"), expected);
    }
    validate_orientation(b)?;
    if let Some(friction) = b.friction
        && !(0.0..=2.0).contains(&friction)
    {
        return invalid("friction", friction.to_string(), "0 to 2".into());
    }
    let max_spin = max_spin(b);
    for (field, vector, unit, max, expected) in [
        ("velocity", &b.velocity, " m/s", MAX_SPEED, format!("a speed of at most {MAX_SPEED} m/s")),
        (
            "spin",
            &b.spin,
            " rad/s",
            max_spin,
            format!("at most {max_spin:.1} rad/s about this axis, where a corner moves at 100 m/s"),
        ),
    ] {
        if b.fixed && *vector != [0.0; 3] {
            return invalid(field, list(vector, unit), "zeros for a fixed block".into());
        }
        if !(0.0..=max).contains(&length(vector)) {
            return invalid(field, list(vector, unit), expected);
        }
    }
    Ok(())
}

/// Maximum spin of a block about the axis of its spin, rad/s: that at which the fastest corner has
/// [`MAX_SPEED`] about the centre.
fn max_spin(b: &Block) -> f64 {
    let spin = DVec3::from_array(b.spin);
    let largest = spin.abs().max_element();
    if largest == 0.0 || !largest.is_finite() {
        return 0.0;
    }
    let q = DQuat::from_array(b.rotation());
    let half = DVec3::from_array(b.size) / 2.0;
    let axis = q.conjugate() * (spin / largest).normalize();
    // Opposite corners are equally fast.
    let corners = [[1.0, 1.0, 1.0], [-1.0, 1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, -1.0]];
    MAX_SPEED / corners.iter().map(|&signs| axis.cross(half * DVec3::from_array(signs)).length()).fold(0.0, f64::max)
}

fn validate_orientation(b: &Block) -> Result<(), SceneError> {
    angle(format!("block {}: ", b.id), "yaw", b.yaw)?;
    let invalid = |field, value: String, expected: &str| {
        Err(SceneError::Block { id: b.id, field, value, expected: expected.to_owned() })
    };
    let Some(q) = b.orientation else { return Ok(()) };
    if b.yaw != 0.0 {
        return invalid("yaw", b.yaw.to_string(), "0 for a block with `orientation`");
    }
    let length = length(&q);
    if !(1.0 - MAX_LENGTH_ERROR..=1.0 + MAX_LENGTH_ERROR).contains(&length) {
        let value = format!("{}, a quaternion of length {length:.4}", list(&q, ""));
        return invalid("orientation", value, "length 1, within 0.001");
    }
    Ok(())
}

/// Checks an angle in rad. `location` is the block with a colon and a space, or empty.
fn angle(location: String, field: &'static str, value: f64) -> Result<(), SceneError> {
    if value.abs() <= MAX_ANGLE {
        return Ok(());
    }
    if value.abs() <= 720.0 {
        return Err(SceneError::Degrees { location, field, value, radians: value.to_radians() });
    }
    Err(SceneError::Angle { location, field, value })
}

fn length(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
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

fn list(v: &[f64], unit: &str) -> String {
    let numbers: Vec<String> = v.iter().map(f64::to_string).collect();
    format!("[{}]{unit}", numbers.join(", "))
}
