//! Arguments shared by commands.

mod engine;
mod material;
mod number;
mod rules;

pub use engine::EngineArguments;
pub use material::Material;
pub use number::number;
pub use rules::RulesArguments;
