//! Hand of a player as people have it: it aims with errors, sees late, trembles, and corrects what
//! it feels.

pub mod noise;
pub mod percept;
pub mod stage;
pub mod take;
