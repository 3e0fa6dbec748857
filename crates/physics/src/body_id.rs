//! Handles to the bodies of a world.

use std::fmt;

use serde::{Deserialize, Serialize};

/// A body of a world: its index in order of creation, which is the order of the scene's blocks.
///
/// ```
/// use teeter_physics::{BodyId, Params, World};
///
/// let world = World::new(&teeter_scene::named("column").unwrap(), Params::default())?;
/// assert_eq!(world.bodies().next(), Some(BodyId(0)));
/// assert_eq!(world.body(1000), None);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct BodyId(pub u32);

impl BodyId {
    /// Index into arrays with an entry a body.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

impl From<u32> for BodyId {
    fn from(index: u32) -> Self {
        Self(index)
    }
}

impl fmt::Display for BodyId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}
