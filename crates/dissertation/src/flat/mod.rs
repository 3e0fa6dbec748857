//! Two prototypes of section 3.4, and the other methods of chapter 2, in the plane.

pub mod axes;
pub mod body;
pub mod constraint;
pub mod lcp;
pub mod manifold;
pub mod micro;
pub mod penalty;
pub mod resting;
pub mod rigid;
pub mod scene;
pub mod springs;
mod step;

pub use rigid::{Detection, Method, Rigid2D};
pub use springs::Springs2D;
