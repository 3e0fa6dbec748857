//! Constants as an ini file (section 5.5.1): sections in brackets, `name = value`, comments after
//! `;` or `#`.

use super::constants::Constants;
use super::options::{Culling, Disabling, HandMode, Method, Order};

/// Error in an ini file. Lines count from 1.
///
/// ```
/// use teeter_dissertation::jenga3d::{Constants, IniError};
///
/// let error = Constants::from_ini("[Spring]").unwrap_err();
/// assert_eq!(error, IniError::UnknownSection { line: 1, section: "Spring".into() });
/// assert_eq!(error.to_string(), "line 1: there is no section [Spring]");
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum IniError {
    /// Section that the file format does not have.
    #[error("line {line}: there is no section [{section}]")]
    UnknownSection {
        /// Line.
        line: usize,
        /// Name of the section.
        section: String,
    },
    /// Constant that the section does not have.
    #[error("line {line}: there is no `{name}` in section [{section}]")]
    UnknownName {
        /// Line.
        line: usize,
        /// Name of the section.
        section: String,
        /// Name of the constant.
        name: String,
    },
    /// Value that does not parse.
    #[error("line {line}: `{name}` is `{value}`, expected {expected}")]
    InvalidValue {
        /// Line.
        line: usize,
        /// Name of the constant.
        name: String,
        /// Text of the value.
        value: String,
        /// Values expected.
        expected: &'static str,
    },
    /// Line that is neither a section nor a constant.
    #[error("line {line}: `{text}`, expected `name = value` or `[Section]`")]
    Syntax {
        /// Line.
        line: usize,
        /// Text of the line.
        text: String,
    },
}

/// Constant in an ini file.
struct Entry {
    section: &'static str,
    name: &'static str,
    expected: &'static str,
    read: fn(&mut Constants, &str) -> Option<()>,
    write: fn(&Constants) -> String,
}

macro_rules! entry {
    ($section:literal, $field:ident, $expected:literal) => {
        Entry {
            section: $section,
            name: stringify!($field),
            expected: $expected,
            read: |c, text| {
                c.$field = text.parse().ok()?;
                Some(())
            },
            write: |c| c.$field.to_string(),
        }
    };
    ($section:literal, $field:ident one of $all:expr) => {
        Entry {
            section: $section,
            name: stringify!($field),
            expected: $all.0,
            read: |c, text| {
                c.$field = $all.1.into_iter().find(|(name, _)| *name == text)?.1;
                Some(())
            },
            write: |c| {
                $all.1
                    .into_iter()
                    .find(|(_, value)| *value == c.$field)
                    .map_or(String::new(), |(name, _)| name.to_owned())
            },
        }
    };
}

const METHODS: (&str, [(&str, Method); 4]) = (
    "euler, multi, midpoint or rk4",
    [("euler", Method::Euler), ("multi", Method::Multi), ("midpoint", Method::Midpoint), ("rk4", Method::Rk4)],
);
const ORDERS: (&str, [(&str, Order); 3]) = (
    "naive, bottom-up or top-down",
    [("naive", Order::Naive), ("bottom-up", Order::BottomUp), ("top-down", Order::TopDown)],
);
const CULLINGS: (&str, [(&str, Culling); 4]) = (
    "none, blocks, boxes or planes",
    [("none", Culling::None), ("blocks", Culling::Blocks), ("boxes", Culling::Boxes), ("planes", Culling::Planes)],
);
const DISABLINGS: (&str, [(&str, Disabling); 3]) =
    ("off, listed or rigid", [("off", Disabling::Off), ("listed", Disabling::Listed), ("rigid", Disabling::Rigid)]);
const HANDS: (&str, [(&str, HandMode); 3]) = (
    "force, velocity or hybrid",
    [("force", HandMode::Force), ("velocity", HandMode::Velocity), ("hybrid", HandMode::Hybrid)],
);

const ENTRIES: &[Entry] = &[
    entry!("Simulation", frame_rate, "a number, 1/s"),
    entry!("Simulation", mid_loop_count, "a whole number"),
    entry!("Simulation", gravity, "a number, m/s²"),
    entry!("Simulation", row_spacing, "a number, m"),
    entry!("Integration", method one of METHODS),
    entry!("Integration", iterations_per_frame, "a whole number"),
    entry!("Springs", stiffness, "a number, N/m"),
    entry!("Springs", damping, "a number, N s/m"),
    entry!("Contact", restitution, "a number, 0 to 1"),
    entry!("Contact", tolerance, "a number, m"),
    entry!("Contact", max_sweeps, "a whole number"),
    entry!("Contact", order one of ORDERS),
    entry!("Contact", culling one of CULLINGS),
    entry!("Contact", listed_boxes, "true or false"),
    entry!("Contact", skip_unchanged, "true or false"),
    entry!("Friction", friction_enabled, "true or false"),
    entry!("Friction", friction, "a number"),
    entry!("Friction", drag, "a number, N s/m"),
    Entry {
        section: "Friction",
        name: "static_friction",
        expected: "a number or none",
        read: |c, text| {
            c.static_friction = if text == "none" { None } else { Some(text.parse().ok()?) };
            Some(())
        },
        write: |c| c.static_friction.map_or("none".to_owned(), |mu| mu.to_string()),
    },
    entry!("Disabling", disabling one of DISABLINGS),
    entry!("Disabling", disable_threshold, "a number, m"),
    entry!("Disabling", reactivation_impulse, "a number, N s"),
    entry!("Disabling", rest_time, "a number, s"),
    entry!("Disabling", rest_distance, "a number, m"),
    entry!("Hand", hand one of HANDS),
    entry!("Hand", hand_stiffness, "a number, N/m"),
    entry!("Hand", hand_rate, "a number, 1/s"),
    entry!("Hand", contact_memory, "a whole number"),
];

impl Constants {
    /// Parses an ini file; constants that it does not set have their defaults.
    ///
    /// # Errors
    /// Names the line of an unknown section or name, a value that does not parse, or another
    /// syntax. Ranges are checked by [`Jenga3D::new`](super::simulator::Jenga3D::new).
    pub fn from_ini(text: &str) -> Result<Self, IniError> {
        let mut constants = Self::default();
        let mut section: &str = "";
        for (n, whole) in text.lines().enumerate() {
            let (line, text) = (n + 1, whole.split([';', '#']).next().unwrap_or_default().trim());
            if text.is_empty() {
                continue;
            }
            if let Some(name) = text.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')) {
                section = name.trim();
                if ENTRIES.iter().all(|e| e.section != section) {
                    return Err(IniError::UnknownSection { line, section: section.to_owned() });
                }
                continue;
            }
            let Some((name, value)) = text.split_once('=') else {
                return Err(IniError::Syntax { line, text: text.to_owned() });
            };
            let (name, value) = (name.trim().to_owned(), value.trim().to_owned());
            let Some(entry) = ENTRIES.iter().find(|e| e.section == section && e.name == name) else {
                return Err(IniError::UnknownName { line, section: section.to_owned(), name });
            };
            if (entry.read)(&mut constants, &value).is_none() {
                return Err(IniError::InvalidValue { line, name, value, expected: entry.expected });
            }
        }
        Ok(constants)
    }

    /// Formats all constants as an ini file.
    pub fn to_ini(&self) -> String {
        let mut text = String::new();
        let mut section = "";
        for entry in ENTRIES {
            if entry.section != section {
                section = entry.section;
                text += &format!("[{section}]\n");
            }
            text += &format!("{} = {}\n", entry.name, (entry.write)(self));
        }
        text
    }
}
