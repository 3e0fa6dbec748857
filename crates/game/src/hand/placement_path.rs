//! Path of a carried block to its slot: rise, cross, lower. The pose is never set; each stage
//! follows from where the block is.

use glam::{DQuat, DVec3};

use crate::orientation::{angle_between, nearest_alike};
use crate::tower_map::Slot;

/// Height above the slot at which a block waits to be let go, m.
const HOVER: f64 = 0.0015;
/// Depth below the slot that the hand aims for to set the block down, m: contact stops it.
const PRESS: f64 = 0.002;
/// Offsets (m) and angles (rad) within which a block begins to be lowered, and within which it goes
/// on being lowered.
const BEGIN: (f64, f64) = (0.0008, 0.015);
const CONTINUE: (f64, f64) = (0.003, 0.06);
/// Offset beyond which a block rises before it crosses, m.
const BESIDE: f64 = 0.012;
/// Depth below the crossing height at which a block may still cross, m.
const SAG: f64 = 0.005;
/// Speeds of the hand, m/s.
const TRAVEL_SPEED: f64 = 0.3;
const LOWERING_SPEED: f64 = 0.04;

/// Stage of a placement.
///
/// ```
/// use glam::{DQuat, DVec3};
/// use teeter_game::{Slot, Stage, waypoint};
///
/// let (position, orientation) = (DVec3::Z * 0.3, DQuat::IDENTITY);
/// let slot = Slot { row: 18, cell: 1, position, orientation, clearance: 0.02 };
/// let stage = |centre| waypoint(centre, orientation, &slot, true).stage;
/// assert_eq!(stage(DVec3::new(0.1, 0.0, 0.32)), Stage::Cross);
/// assert_eq!(stage(DVec3::new(0.0, 0.0, 0.32)), Stage::Lower);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// Up beside the tower.
    Rise,
    /// Sideways to above the slot, with the orientation of the slot.
    Cross,
    /// Down into the slot.
    Lower,
}

/// Next point of the path.
///
/// ```
/// use glam::{DQuat, DVec3};
/// use teeter_game::{Slot, Waypoint, waypoint};
///
/// let (position, orientation) = (DVec3::Z * 0.3, DQuat::IDENTITY);
/// let slot = Slot { row: 18, cell: 1, position, orientation, clearance: 0.02 };
/// let Waypoint { centre, max_speed, .. } = waypoint(position, orientation, &slot, true);
/// // the last stage is slow and goes on until contact stops it
/// assert!(centre.z < position.z && max_speed < 0.05);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Waypoint {
    /// Position wanted for the centre, m.
    pub centre: DVec3,
    /// Orientation wanted.
    pub orientation: DQuat,
    /// Stage.
    pub stage: Stage,
    /// Largest speed of the hand, m/s.
    pub max_speed: f64,
}

/// Next waypoint of a block at `centre` with `orientation` to a slot. It hovers above the slot
/// unless `set_down`: then it goes on until it touches.
///
/// ```
/// use glam::{DQuat, DVec3};
/// use teeter_game::{Slot, Stage, waypoint};
///
/// let (position, orientation) = (DVec3::Z * 0.3, DQuat::IDENTITY);
/// let slot = Slot { row: 18, cell: 1, position, orientation, clearance: 0.02 };
/// let beside = DVec3::new(0.2, 0.0, 0.1);
/// assert_eq!(waypoint(beside, orientation, &slot, true).stage, Stage::Rise);
/// ```
pub fn waypoint(centre: DVec3, orientation: DQuat, slot: &Slot, set_down: bool) -> Waypoint {
    let wanted = nearest_alike(slot.orientation, orientation);
    let offset = (centre - slot.position).truncate().length();
    let height = slot.position.z + slot.clearance;
    let is_low = centre.z < height - SAG;
    let (centre, stage, max_speed) = if offset > BESIDE && is_low {
        (centre.with_z(height), Stage::Rise, TRAVEL_SPEED)
    } else {
        let (max_offset, max_angle) = if is_low { CONTINUE } else { BEGIN };
        if offset > max_offset || angle_between(wanted, orientation) > max_angle {
            (slot.position.with_z(height), Stage::Cross, TRAVEL_SPEED)
        } else {
            let drop = if set_down { -PRESS } else { HOVER };
            (slot.position + DVec3::Z * drop, Stage::Lower, LOWERING_SPEED)
        }
    };
    Waypoint { centre, orientation: wanted, stage, max_speed }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blocks::samples::{SIZE, tower};
    use crate::orientation::rotation_about_z;
    use crate::tower_map::TowerMap;

    fn slots() -> Vec<Slot> {
        TowerMap::new(&tower(&["xxx", "xxx", "xxx"], 0.0), None).slots(SIZE)
    }

    #[test]
    fn the_path_to_a_slot_rises_crosses_and_lowers() {
        let slot = slots()[1];
        let level = slot.orientation;
        let beside = DVec3::new(0.12, 0.02, 0.03);
        let rise = waypoint(beside, level, &slot, false);
        assert_eq!(rise.stage, Stage::Rise);
        assert_eq!(rise.centre.truncate(), beside.truncate());
        assert!((rise.centre.z - (slot.position.z + slot.clearance)).abs() < 5e-10);
        assert!(slot.clearance > SIZE.z, "over a neighbour of the same height");
        let cross = waypoint(rise.centre, level, &slot, false);
        assert_eq!(cross.stage, Stage::Cross);
        let over = waypoint(cross.centre, cross.orientation, &slot, false);
        assert_eq!(over.stage, Stage::Lower);
        assert!(over.centre.z > slot.position.z, "waits above its slot");
        let down = waypoint(cross.centre, cross.orientation, &slot, true);
        assert!(down.centre.z < slot.position.z, "goes on until it touches");
    }

    #[test]
    fn a_block_askew_over_its_slot_is_rotated_before_it_is_lowered() {
        let slot = slots()[0];
        let askew = slot.orientation * rotation_about_z(0.3);
        let next = waypoint(slot.position + DVec3::Z * slot.clearance, askew, &slot, true);
        assert_eq!(next.stage, Stage::Cross);
        assert!(angle_between(next.orientation, slot.orientation) < 1e-6);
    }
}
