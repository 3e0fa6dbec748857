//! Space of the tower that a carried block keeps out of: below the top its path goes round the
//! front, as a player's hand would.

use glam::DVec3;

use crate::tower_map::Slot;

/// Space left beside the tower, m.
const MARGIN: f64 = 0.006;

/// Upright cylinder around the tower.
///
/// ```
/// use glam::DVec3;
/// use teeter_game::TowerColumn;
///
/// let column = TowerColumn { axis: DVec3::ZERO, radius: 0.1, height: 0.3 };
/// let kept = column.keep_clear(DVec3::ZERO, DVec3::X, DVec3::X);
/// assert_eq!(kept, DVec3::X * 0.1);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TowerColumn {
    /// Point on the axis of the tower; its height has no meaning.
    pub axis: DVec3,
    /// Distance from the axis at which the centre of a block is clear of the tower, m.
    pub radius: f64,
    /// Height above which the centre of a block is clear of the tower, m.
    pub height: f64,
}

impl TowerColumn {
    /// The column that a block of edge lengths `size` (m) keeps out of, from the slots on top; none
    /// without slots.
    pub fn under(slots: &[Slot], size: DVec3) -> Option<Self> {
        let first = slots.first()?;
        let axis = slots.iter().map(|slot| slot.position).sum::<DVec3>() / slots.len() as f64;
        let half = 0.5 * size.x;
        let radius = std::f64::consts::SQRT_2 * half + half + MARGIN;
        Some(Self { axis, radius, height: axis.z + first.clearance })
    }

    /// Returns true if a block at `centre` is clear of the tower.
    pub fn is_clear(&self, centre: DVec3) -> bool {
        centre.z > self.height || (centre - self.axis).truncate().length() >= self.radius
    }

    /// Moves a centre out of the column along the line of sight, so that it keeps its position on
    /// the screen.
    ///
    /// `toward_viewer` is a horizontal unit vector. A block that is behind the tower (`present`)
    /// stays behind it.
    pub fn keep_clear(&self, centre: DVec3, present: DVec3, toward_viewer: DVec3) -> DVec3 {
        if self.is_clear(centre) {
            return centre;
        }
        let offset = (centre - self.axis).with_z(0.0);
        let along = offset.dot(toward_viewer);
        let root = (along * along - offset.length_squared() + self.radius * self.radius).sqrt();
        let is_behind = (present - self.axis).dot(toward_viewer) < 0.0;
        centre + toward_viewer * (if is_behind { -along - root } else { -along + root })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blocks::samples::{SIZE, tower};
    use crate::tower_map::TowerMap;

    #[test]
    fn below_the_top_the_hand_keeps_in_front_of_the_tower_and_above_it_moves_freely() {
        let slots = TowerMap::new(&tower(&["xxx", "xxx", "xxx"], 0.0), None).slots(SIZE);
        let column = TowerColumn::under(&slots, SIZE).unwrap();
        let toward_viewer = DVec3::new(0.6, -0.8, 0.0);
        let front = DVec3::new(0.09, -0.1, 0.03);
        for wanted in [[0.0, 0.0, 0.03], [0.03, 0.05, 0.02], [-0.05, 0.01, 0.05]].map(DVec3::from) {
            let moved = column.keep_clear(wanted, front, toward_viewer);
            let offset = (moved - column.axis).with_z(0.0);
            assert!((offset.length() - column.radius).abs() < 5e-10);
            assert!(offset.dot(toward_viewer) > 0.0);
            assert!((moved - wanted).cross(toward_viewer).length() < 1e-9, "along the line of sight");
            let behind = column.keep_clear(wanted, -front, toward_viewer);
            assert!((behind - column.axis).dot(toward_viewer) < 0.0);
        }
        for free in [DVec3::new(0.0, 0.0, column.height + 0.01), DVec3::new(0.3, 0.0, 0.03)] {
            assert_eq!(column.keep_clear(free, front, toward_viewer), free);
        }
    }
}
