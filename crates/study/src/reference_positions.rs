//! Displacement of blocks from reference positions.

use teeter_physics::{BodyId, World};

/// Centres of the blocks of a world at one time, m: the reference of displacements. That of
/// falls is [`crate::Footing`].
///
/// ```
/// use teeter_physics::{Params, World};
/// use teeter_study::ReferencePositions;
///
/// let mut world = World::new(&teeter_scene::named("column").unwrap(), Params::default())?;
/// let start = ReferencePositions::of(&world);
/// world.run_for(0.5);
/// assert!(start.max_displacement(&world) < 1e-4);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone)]
pub struct ReferencePositions(Vec<[f64; 3]>);

impl ReferencePositions {
    /// Present positions of the blocks of `world`.
    pub fn of(world: &World) -> Self {
        Self(world.bodies().map(|body| world.pose(body).position.to_array()).collect())
    }

    /// Displacement of each block, m.
    fn displacements<'a>(&'a self, world: &'a World) -> impl Iterator<Item = f64> + 'a {
        self.0.iter().zip(world.bodies()).map(|(start, body)| {
            let now = world.pose(body).position;
            let d = [now[0] - start[0], now[1] - start[1], now[2] - start[2]];
            (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt()
        })
    }

    /// Largest displacement of any block, m; NaN where one is not a number.
    pub fn max_displacement(&self, world: &World) -> f64 {
        self.displacements(world).fold(0.0, max)
    }

    /// Largest displacement of any block but `body`, m; NaN where one is not a number.
    pub fn max_displacement_except(&self, world: &World, body: BodyId) -> f64 {
        let others = self.displacements(world).enumerate().filter(|(i, _)| *i != body.index());
        others.map(|(_, displacement)| displacement).fold(0.0, max)
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
