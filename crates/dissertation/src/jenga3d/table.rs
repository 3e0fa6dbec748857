//! Table of all constants (section 5.5.1): the one list that ini file, shell and page read.

use super::constant::{Constant, ConstantError, Range, Value};
use super::constants::Constants;
use super::options::{Culling, Disabling, HandMode, Method, Order, SpringSet};

/// Entry of the table. The kind of the range decides how the field is read and written.
macro_rules! constant {
    ($section:literal, $field:ident, $unit:literal, number $min:literal to $max:literal, $meaning:literal, $reason:literal) => {
        Constant {
            section: $section,
            name: stringify!($field),
            unit: $unit,
            range: Range::Number { min: $min, max: $max },
            meaning: $meaning,
            reason: $reason,
            get: |c| Value::Number(c.$field),
            set: |c, value| {
                if let Value::Number(x) = value {
                    c.$field = x;
                }
            },
        }
    };
    ($section:literal, $field:ident, $unit:literal, optional $min:literal to $max:literal, $meaning:literal, $reason:literal) => {
        Constant {
            section: $section,
            name: stringify!($field),
            unit: $unit,
            range: Range::NumberOrNone { min: $min, max: $max },
            meaning: $meaning,
            reason: $reason,
            get: |c| c.$field.map_or(Value::None, Value::Number),
            set: |c, value| match value {
                Value::Number(x) => c.$field = Some(x),
                Value::None => c.$field = None,
                _ => {}
            },
        }
    };
    ($section:literal, $field:ident, $unit:literal, whole $min:literal to $max:literal, $meaning:literal, $reason:literal) => {
        Constant {
            section: $section,
            name: stringify!($field),
            unit: $unit,
            range: Range::Whole { min: $min, max: $max },
            meaning: $meaning,
            reason: $reason,
            get: |c| Value::Whole(c.$field),
            set: |c, value| {
                if let Value::Whole(n) = value {
                    c.$field = n;
                }
            },
        }
    };
    ($section:literal, $field:ident, switch, $meaning:literal, $reason:literal) => {
        Constant {
            section: $section,
            name: stringify!($field),
            unit: "",
            range: Range::Switch,
            meaning: $meaning,
            reason: $reason,
            get: |c| Value::Switch(c.$field),
            set: |c, value| {
                if let Value::Switch(on) = value {
                    c.$field = on;
                }
            },
        }
    };
    ($section:literal, $field:ident, one of $type:ident, $meaning:literal, $reason:literal) => {
        Constant {
            section: $section,
            name: stringify!($field),
            unit: "",
            range: Range::Choice { names: $type::NAMES, aliases: $type::ALIASES },
            meaning: $meaning,
            reason: $reason,
            get: |c| Value::Choice(c.$field.name()),
            set: |c, value| {
                if let Value::Choice(name) = value
                    && let Some(choice) = $type::from_name(name)
                {
                    c.$field = choice;
                }
            },
        }
    };
}

/// All constants, section by section.
///
/// ```
/// use teeter_dissertation::jenga3d::TABLE;
///
/// assert!(TABLE.iter().any(|constant| constant.name == "mid_loop_count"));
/// ```
pub static TABLE: &[Constant] = &[
    constant!("Simulation", frame_rate, "1/s", number 1.0 to 1000.0,
        "frames in a second of simulated time",
        "displays show sixty frames a second"),
    constant!("Simulation", mid_loop_count, "", whole 1 to 10_000,
        "steps of integrating, colliding and accepting in a frame (midLoopCount of Figure 5.2)",
        "short against the period of a corner on its springs: with 16, towers fall"),
    constant!("Simulation", gravity, "m/s²", number 0.0 to 100.0,
        "acceleration of gravity, downwards",
        "standard gravity; a shell or a page takes that of the scene"),
    constant!("Simulation", row_spacing, "m", number 0.0 to 1.0,
        "distance between rows at the start, from which they fall onto each other (section 5.2.1)",
        "more than blocks differ in height, less than a fall that would shake the tower"),
    constant!("Integration", method, one of Method,
        "integrator (section 4.3.2)",
        "the one that the dissertation settled on (section 5.5.2)"),
    constant!("Integration", iterations_per_frame, "", whole 1 to 100,
        "steps of multistep in each step of the loop (iterationsPerFrame of appendix 2.1); other methods take one",
        "stable springs at a low price: forces cost less than collisions"),
    constant!("Springs", springs, one of SpringSet,
        "springs of a block: all 28, the 24 of its sides, or the 18 sides of its faces",
        "section 4.1 connects every pair of particles"),
    constant!("Springs", stiffness, "N/m", number 1.0 to 1e9,
        "stiffness of every spring; a block is about six times as stiff along each axis",
        "a full tower sinks by half a millimetre; steps half as long hold springs four times as stiff"),
    constant!("Springs", damping, "N s/m", number 0.0 to 1e4,
        "damping of every spring",
        "blocks stop vibrating within a few milliseconds"),
    constant!("Contact", restitution, "", number 0.0 to 1.0,
        "ratio of the speeds after and before a collision (Eq. 2.11)",
        "wood hardly bounces; at 0 only rounding separates blocks at rest"),
    constant!("Contact", tolerance, "m", number 0.0 to 1e-3,
        "enlargement of faces and edges in detection",
        "rounding must leave no gap between the two triangles of a side"),
    constant!("Contact", max_sweeps, "", whole 1 to 1000,
        "maximum number of rounds over the pairs in one call of CollideBlocks",
        "four times the couple of rounds that section 6.2.2 states"),
    constant!("Contact", order, one of Order,
        "order of the pairs (section 3.3.4)",
        "Figure 5.5 takes pairs as they were created"),
    constant!("Contact", culling, one of Culling,
        "tests before the exact one (section 4.4.3): none, boxes of blocks, boxes of their parts, planes and lines; \
         off is none, on is planes",
        "all that the dissertation has (Table 5.2)"),
    constant!(
        "Contact",
        listed_boxes,
        switch,
        "boxes compared as Figure 5.5 lists it, which leaves more tests",
        "the listing compares the wrong point and face"
    ),
    constant!(
        "Contact",
        skip_unchanged,
        switch,
        "pairs skipped whose blocks have not changed since their last test in the step",
        "it saves tests and changes no result"
    ),
    constant!("Friction", friction_enabled, switch, "contacts with friction (Table 5.1)", "requirement 2.2"),
    constant!("Friction", friction, "", number 0.0 to 10.0,
        "coefficient of kinetic friction (Eq. 2.18)",
        "wood on wood; a shell or a page takes that of the scene"),
    constant!("Friction", drag, "N s/m", number 0.0 to 100.0,
        "drag of a contact across its normal (section 5.7.2)",
        "small beside friction at the speeds of play"),
    constant!("Friction", static_friction, "", optional 0.0 to 10.0,
        "coefficient of static friction (section 6.3); kinetic friction is at most that",
        "the method of 2003 has kinetic friction only"),
    constant!("Disabling", disabling, one of Disabling,
        "rule that disables blocks: none, that of appendix 2.5, or the rigid motion of a block (section 6.3)",
        "appendix 2.5"),
    constant!("Disabling", disable_threshold, "m", number 0.0 to 1e-3,
        "sum of the distances that the particles of a block move in a step, below which it is disabled",
        "the 2e-4 of appendix 2.5 has no unit and belongs to an unknown step; this disables about the share of Figure \
         6.22"),
    constant!("Disabling", reactivation_impulse, "N s", number 0.0 to 1.0,
        "impulse of a collision that enables a disabled block (section 4.7)",
        "above the impulses of a tower at rest"),
    constant!("Disabling", rest_time, "s", number 0.01 to 60.0,
        "time over which rigid-motion compares the poses of a block",
        "long against a vibration, short against a pause in play"),
    constant!("Disabling", rest_distance, "m", number 0.0 to 1e-3,
        "maximum displacement of a corner of a resting block within that time",
        "not visible, and above the creep of a tower within that time"),
    constant!("Hand", hand, one of HandMode,
        "method of the hand: force, velocity, or force in contact and velocity in the air (section 5.6)",
        "the one that the dissertation settled on"),
    constant!("Hand", hand_stiffness, "N/m", number 0.0 to 1e4,
        "force of the hand per distance between block and target",
        "0.4 N at a centimetre, which draws a loose block and leaves a loaded one"),
    constant!("Hand", hand_rate, "1/s", number 0.0 to 1000.0,
        "velocity written by the hand per distance between block and target",
        "a block follows within a twentieth of a second"),
    constant!("Hand", contact_memory, "", whole 0 to 100_000,
        "steps after its last collision for which a block counts as in contact",
        "a block at rest collides in one of several steps"),
];

impl Constant {
    /// Returns the constant of that name.
    pub fn find(name: &str) -> Option<&'static Constant> {
        TABLE.iter().find(|constant| constant.name == name)
    }
}

impl Constants {
    /// Value of the constant of that name.
    pub fn value(&self, name: &str) -> Option<Value> {
        Constant::find(name).map(|constant| constant.value(self))
    }

    /// Sets a constant to the value that a text names.
    ///
    /// # Errors
    /// Names an unknown constant, or a value that is not accepted; nothing is then changed.
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), ConstantError> {
        let constant = Constant::find(name).ok_or_else(|| ConstantError::Unknown { name: name.to_owned() })?;
        let value = constant.parse(text)?;
        (constant.set)(self, value);
        Ok(())
    }

    /// Checks each constant against its range.
    ///
    /// # Errors
    /// Names the first constant out of its range.
    pub fn check_ranges(&self) -> Result<(), ConstantError> {
        match TABLE.iter().find(|constant| !constant.accepts(constant.value(self))) {
            Some(constant) => Err(constant.error(constant.value(self).to_string())),
            None => Ok(()),
        }
    }
}
