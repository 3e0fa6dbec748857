//! Displacement of blocks from reference positions.

use teeter_physics::{BodyId, World};

use crate::fall::{has_dropped, has_fallen};

/// Centres of the blocks of a world at one time, m: the reference of displacements and falls.
///
/// ```
/// use teeter_physics::{Params, World};
/// use teeter_study::ReferencePositions;
///
/// let mut world = World::new(&teeter_scene::named("column").unwrap(), Params::default())?;
/// let start = ReferencePositions::of(&world);
/// world.run_for(0.5);
/// assert!(start.max_displacement(&world) < 1e-4 && !start.any_fallen(&world));
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone)]
pub struct ReferencePositions(Vec<[f64; 3]>);

impl ReferencePositions {
    /// Present positions of the blocks of `world`.
    pub fn of(world: &World) -> Self {
        Self(world.bodies().map(|body| world.pose(body).position.to_array()).collect())
    }

    /// Displacement and drop of each block, m.
    fn displacements<'a>(&'a self, world: &'a World) -> impl Iterator<Item = (f64, f64)> + 'a {
        self.0.iter().zip(world.bodies()).map(|(start, body)| {
            let now = world.pose(body).position;
            let d = [now[0] - start[0], now[1] - start[1], now[2] - start[2]];
            ((d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt(), -d[2])
        })
    }

    /// Largest displacement of any block, m; NaN where one is not a number.
    pub fn max_displacement(&self, world: &World) -> f64 {
        self.displacements(world).map(|(displacement, _)| displacement).fold(0.0, max)
    }

    /// Largest displacement of any block but `body`, m; NaN where one is not a number.
    pub fn max_displacement_except(&self, world: &World, body: BodyId) -> f64 {
        let others = self.displacements(world).enumerate().filter(|(i, _)| *i != body.index());
        others.map(|(_, (displacement, _))| displacement).fold(0.0, max)
    }

    /// Returns true if any block has fallen, see [`has_fallen`].
    pub fn any_fallen(&self, world: &World) -> bool {
        self.displacements(world).any(|(displacement, drop)| has_fallen(displacement, drop))
    }

    /// Returns true if any block but `body` has fallen, see [`has_fallen`].
    pub fn any_fallen_except(&self, world: &World, body: BodyId) -> bool {
        let mut others = self.displacements(world).enumerate().filter(|(i, _)| *i != body.index());
        others.any(|(_, (displacement, drop))| has_fallen(displacement, drop))
    }

    /// Returns true if any block has dropped, see [`has_dropped`].
    pub fn any_dropped(&self, world: &World) -> bool {
        self.displacements(world).any(|(_, drop)| has_dropped(drop))
    }

    /// Sets the mark of each block that has fallen, see [`has_fallen`]; leaves the other marks.
    pub fn mark_fallen(&self, world: &World, fallen: &mut [bool]) {
        for (mark, (displacement, drop)) in fallen.iter_mut().zip(self.displacements(world)) {
            *mark |= has_fallen(displacement, drop);
        }
    }
}

/// The larger of two numbers; NaN where either is NaN, which `f64::max` would drop.
fn max(a: f64, b: f64) -> f64 {
    if b <= a || a.is_nan() { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_displacement_that_is_not_a_number_is_the_largest() {
        assert!([1.0, f64::NAN, 2.0].into_iter().fold(0.0, max).is_nan());
        assert_eq!([1.0, 3.0, 2.0].into_iter().fold(0.0, max), 3.0);
    }
}
