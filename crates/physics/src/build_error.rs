//! Error of building a world.

use crate::constants::MAX_SUBSTEPS;

/// Error of [`World::new`](crate::World::new) and [`World::set_form`](crate::World::set_form).
///
/// ```
/// use teeter_physics::{BuildError, Params, World};
///
/// let mut scene = teeter_scene::named("column").unwrap();
/// scene.blocks[2].mass = -1.0;
/// let error = World::new(&scene, Params::default()).unwrap_err();
/// assert!(matches!(error, BuildError::Scene(_)));
/// assert!(error.to_string().contains("mass"), "{error}");
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BuildError {
    /// A constant of the run is out of its range.
    #[error("parameter `{field}` is {value}, expected {expected}")]
    Param {
        /// Name of the field.
        field: &'static str,
        /// Its value.
        value: f64,
        /// The range expected.
        expected: &'static str,
    },
    /// More blocks are near each other than a world can hold.
    #[error(
        "the bounding boxes of more than {limit} pairs of blocks overlap: long blocks at an angle \
         are too dense, use fewer or shorter ones, or turn them along x and y"
    )]
    Crowded {
        /// Maximum number of pairs.
        limit: usize,
    },
    /// The lightest block needs more substeps than a frame may have.
    #[error(
        "block {id}: `mass` is {mass:.1e} kg, which takes {substeps:.1e} substeps a frame at this stiffness, and \
         at most {MAX_SUBSTEPS} are run: expected at least {min_mass:.1e} kg, or contacts and springs softer by \
         a factor of {factor:.1e}"
    )]
    Substeps {
        /// Id of the block.
        id: u32,
        /// Its mass, kg.
        mass: f64,
        /// Substeps of a frame that it takes.
        substeps: f64,
        /// Smallest mass that the substeps allow, kg.
        min_mass: f64,
        /// Factor by which the stiffness is too large.
        factor: f64,
    },
    /// A contact of the scene would give by too much under the weight that rests on it.
    #[error(
        "block {id}: {load:.1e} N rest on {bearer}, and the contact would give by {depth:.1e} m, more than a \
         tenth of the thinner block: expected a `stiffness` of at least {stiffness:.1e} N/m, or lighter blocks"
    )]
    Overload {
        /// Id of the block that sinks.
        id: u32,
        /// Block or floor that bears it.
        bearer: String,
        /// Load of the contact, N.
        load: f64,
        /// Depth to which the block would sink, m.
        depth: f64,
        /// Stiffness of the scene that would do, N/m.
        stiffness: f64,
    },
    /// The scene cannot be simulated.
    #[error(transparent)]
    Scene(#[from] teeter_scene::SceneError),
}
