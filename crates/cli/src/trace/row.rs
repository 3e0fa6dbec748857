//! Row of a trace, the same in each format.

use serde::ser::SerializeStruct;
use serde::{Serialize, Serializer};
use teeter_physics::{BodyId, World};

/// Names of the columns of numbers, with their units.
pub const NUMBERS: [&str; 14] = [
    "time_s",
    "position_x_m",
    "position_y_m",
    "position_z_m",
    "orientation_x",
    "orientation_y",
    "orientation_z",
    "orientation_w",
    "velocity_x_m_s",
    "velocity_y_m_s",
    "velocity_z_m_s",
    "spin_x_rad_s",
    "spin_y_rad_s",
    "spin_z_rad_s",
];
/// Name of the column of ids.
pub const ID: &str = "id";
/// Names of the columns of flags.
pub const FLAGS: [&str; 2] = ["asleep", "quarantined"];

/// State of a block at a time.
pub struct Row {
    /// Id of the block.
    pub id: u32,
    /// Values of [`NUMBERS`].
    pub numbers: [f64; 14],
    /// Values of [`FLAGS`].
    pub flags: [bool; 2],
}

impl Row {
    /// Present state of a body, whose block has this id.
    pub fn new(world: &World, body: BodyId, id: u32) -> Self {
        let (pose, twist) = (world.pose(body), world.twist(body));
        let (p, q, v, w) = (pose.position, pose.orientation, twist.velocity, twist.spin);
        let numbers = [world.time(), p.x, p.y, p.z, q.x, q.y, q.z, q.w, v.x, v.y, v.z, w.x, w.y, w.z];
        Self { id, numbers, flags: [world.is_asleep(body), world.is_quarantined(body)] }
    }
}

/// The time first, then the id, the other numbers and the flags.
impl Serialize for Row {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut row = serializer.serialize_struct("Row", 1 + NUMBERS.len() + FLAGS.len())?;
        for (i, (name, value)) in NUMBERS.into_iter().zip(&self.numbers).enumerate() {
            row.serialize_field(name, value)?;
            if i == 0 {
                row.serialize_field(ID, &self.id)?;
            }
        }
        for (name, value) in FLAGS.into_iter().zip(&self.flags) {
            row.serialize_field(name, value)?;
        }
        row.end()
    }
}
