#![doc = include_str!("../README.md")]

mod cards;
mod error;
mod form;
mod json;
mod named;
mod notation;
pub mod overlap;
mod penetration;
mod preset;
mod printable;
mod random;
mod scene;
mod settle;
mod text;
mod tower;
mod validate;

pub use cards::{CardsOptions, MAX_STOREYS, cards};
pub use error::SceneError;
pub use form::{Form, Particles, Springs, WOOD_SPRINGS};
pub use json::MAX_BYTES;
pub use named::{NAMED, NamedScene, Stability, named};
pub use notation::{Cell, MAX_ROWS, Notation};
pub use penetration::Penetration;
pub use preset::BlockPreset;
pub use printable::{is_hidden, printable, printable_json, printable_start};
pub use random::Random;
pub use scene::{Block, Scene, default_stiffness, standard_gravity};
pub use settle::{Move, Settlement, settle};
pub use text::{read_text, utf8};
pub use tower::{
    FIELD_PITCH, LOOSE_CLEARANCE, TowerOptions, WOOD_EDGE_RADIUS, WOOD_RESTITUTION, config, field, loose, tower,
};
pub use validate::{MAX_BLOCKS, MAX_OVERLAP, SPRING_DAMPING, SPRING_STIFFNESS, STIFFNESS};
