//! Blocks and materials of a picture.

use crate::shading::light::Lights;
use crate::shading::occlusion::Occlusion;
use crate::shading::shadow::SunDisc;
use crate::shading::table::Table;
use crate::shading::wood::Log;
use crate::solids::Solids;

/// Materials and lights, the same in all pictures of a scene.
#[derive(Debug)]
pub struct Materials {
    /// Logs that the blocks are cut from.
    pub logs: Vec<Log>,
    /// Sun and sky.
    pub lights: Lights,
    /// Directions to the sun.
    pub sun: SunDisc,
    /// Table.
    pub table: Table,
}

/// Blocks in their poses, ready for rays.
#[derive(Debug)]
pub struct Stage {
    /// Blocks.
    pub solids: Solids,
    /// Grid of the wood, which takes the light of the sky.
    pub occlusion: Occlusion,
}
