//! Arguments shared by commands.

mod engine;
mod material;
mod number;

pub use engine::EngineArguments;
pub use material::Material;
pub use number::number;
