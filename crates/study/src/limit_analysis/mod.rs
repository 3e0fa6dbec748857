//! Limit analysis: exact forces in a tower of rigid blocks, by linear programming.
//!
//! *Equilibrium.* The blocks come down as far as they can: min sum m g z over heights and small
//! tilts, without overlap at the corners of each region in which two blocks overlap in plan. The
//! normal forces are the duals. Solved is the dual itself: of all forces that hold every block in
//! equilibrium, those of minimum work against the gaps. Where there are none the tower
//! falls. Random heights determine the load of each block, but faces that lie flat on each other
//! leave open how their corners share it; [`crate::stiff_limit`] takes the solution of stiff
//! springs.
//!
//! *Breakaway.* With those normal forces N there are two bounds. *Straight*: the block slides on
//! the one below, and the block above either slides on it or goes along and slides on the rest of
//! its row. *Turning*: the largest force along the long axis for which friction of at most mu N at
//! each corner can keep every block from sliding and turning in the plane (limit analysis, exact
//! for constant normal forces). The corners of a patch stand for a uniform pressure by the ratio of
//! [`crate::torsion`].
//!
//! *Tipping.* The blocks above a row, with the pulled one among them, rest on their bearers while
//! the resultant of weight and pull passes within the hull of the loaded corners. Beyond that they
//! rock, until loose blocks bear as well.
//!
//! *Tilt.* On a floor that is tilted, friction at each point holds the blocks as well. The largest
//! tangent of the tilt for which forces within the friction cones hold every block is one linear
//! programme. It is exact where blocks topple, and an upper bound where they slide (Drucker 1954).
//!
//! Where nothing lies on a block, or nothing can turn, the first two agree; if the tower does not
//! tip before, the force is exact. Elsewhere all are bounds: friction tilts blocks, which shifts
//! normal forces, and stores forces while the tower settles.

mod breakaway;
mod contact_point;
mod equilibrium;
mod error;
mod frictional;
mod margin;
mod patch;
mod program;
#[cfg(test)]
mod tests;
mod tower;
mod turning;

pub use breakaway::Breakaway;
pub use error::LimitError;
pub use patch::Patch;
pub use tower::RigidTower;
