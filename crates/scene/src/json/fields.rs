//! Fields of scenes, blocks and springs in JSON.

use std::marker::PhantomData;

use serde::de::{DeserializeSeed, Deserializer, IgnoredAny, MapAccess, SeqAccess};
use serde::ser::{SerializeMap, Serializer};
use serde::{Deserialize, Serialize};

use super::names::Known;
use super::object::{Fields, Object, required};
use super::value::{Flag, Gravity, Kind, Number, Numbers, Optional, Text, Value, Whole, Word};
use crate::form::{Form, Particles, Springs};
use crate::scene::{Block, Scene, default_stiffness, standard_gravity};
use crate::validate::MAX_BLOCKS;

/// Maximum length of a name, bytes: that of a configuration of 200 rows, and more.
const MAX_NAME: usize = 10_000;

/// Fields of a scene. The last four are for people and other programs: any value, which is ignored.
const SCENE: Known = (
    "a scene",
    &[
        "name",
        "gravity",
        "friction",
        "kinetic_friction",
        "restitution",
        "stiffness",
        "edge_radius",
        "form",
        "springs",
        "blocks",
        "label",
        "margin",
        "tilt_az",
        "truth",
        "family",
        "rows",
        "comment",
    ],
);

/// Fields of a block. The last one is for people: any value, which is ignored.
const BLOCK: Known = (
    "a block",
    &["id", "size", "mass", "pos", "yaw", "orientation", "velocity", "spin", "fixed", "friction", "comment"],
);

/// Fields of springs.
const SPRINGS: Known = ("springs", &["stiffness", "damping", "particles"]);

impl<'de> Deserialize<'de> for Scene {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Value(Object::<SceneFields>(PhantomData)).deserialize(deserializer)
    }
}

impl<'de> Deserialize<'de> for Block {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Value(Object::<BlockFields>(PhantomData)).deserialize(deserializer)
    }
}

impl<'de> Deserialize<'de> for Springs {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Value(Object::<Springs>(PhantomData)).deserialize(deserializer)
    }
}

impl Serialize for Block {
    /// Omits what has its default; `yaw` only beside an `orientation`, since a file may not have
    /// both.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("id", &self.id)?;
        map.serialize_entry("size", &self.size)?;
        map.serialize_entry("mass", &self.mass)?;
        map.serialize_entry("pos", &self.pos)?;
        match self.orientation {
            Some(q) => map.serialize_entry("orientation", &q)?,
            None => map.serialize_entry("yaw", &self.yaw)?,
        }
        if !is_zero(self.velocity) {
            map.serialize_entry("velocity", &self.velocity)?;
        }
        if !is_zero(self.spin) {
            map.serialize_entry("spin", &self.spin)?;
        }
        if self.fixed {
            map.serialize_entry("fixed", &true)?;
        }
        if let Some(friction) = self.friction {
            map.serialize_entry("friction", &friction)?;
        }
        map.end()
    }
}

/// True for zeros of positive sign: one of negative sign would come back as another bit pattern.
fn is_zero(x: [f64; 3]) -> bool {
    x.iter().all(|x| x.to_bits() == 0)
}

#[derive(Default)]
struct SceneFields {
    name: Option<String>,
    gravity: Option<f64>,
    friction: Option<f64>,
    kinetic_friction: Option<f64>,
    restitution: f64,
    stiffness: Option<f64>,
    edge_radius: f64,
    form: Form,
    springs: Springs,
    blocks: Option<Vec<Block>>,
    label: Option<String>,
    margin: Option<f64>,
    tilt_az: Option<f64>,
}

impl Fields for SceneFields {
    const KNOWN: Known = SCENE;
    const OTHERS: &'static [Known] = &[BLOCK, SPRINGS];
    type Out = Scene;

    fn read<'de, A: MapAccess<'de>>(&mut self, name: &str, map: &mut A) -> Result<(), A::Error> {
        match name {
            "name" => self.name = Some(map.next_value_seed(Value(Text { max: MAX_NAME }))?),
            "gravity" => self.gravity = Some(map.next_value_seed(Value(Gravity))?),
            "friction" => self.friction = Some(map.next_value_seed(Value(Number))?),
            "kinetic_friction" => self.kinetic_friction = map.next_value_seed(Value(Optional(Number)))?,
            "restitution" => self.restitution = map.next_value_seed(Value(Number))?,
            "stiffness" => self.stiffness = Some(map.next_value_seed(Value(Number))?),
            "edge_radius" => self.edge_radius = map.next_value_seed(Value(Number))?,
            "form" => self.form = map.next_value_seed(Value(Word(PhantomData)))?,
            "springs" => self.springs = map.next_value()?,
            "blocks" => self.blocks = Some(map.next_value_seed(Value(Blocks))?),
            "label" => self.label = map.next_value_seed(Value(Optional(Text { max: MAX_NAME })))?,
            "margin" => self.margin = map.next_value_seed(Value(Optional(Number)))?,
            "tilt_az" => self.tilt_az = map.next_value_seed(Value(Optional(Number)))?,
            _ => drop(map.next_value::<IgnoredAny>()?),
        }
        Ok(())
    }

    fn complete(self) -> Result<Scene, String> {
        Ok(Scene {
            name: required(self.name, "name")?,
            gravity: self.gravity.unwrap_or_else(standard_gravity),
            friction: required(self.friction, "friction")?,
            kinetic_friction: self.kinetic_friction,
            restitution: self.restitution,
            stiffness: self.stiffness.unwrap_or_else(default_stiffness),
            edge_radius: self.edge_radius,
            form: self.form,
            springs: self.springs,
            blocks: required(self.blocks, "blocks")?,
            label: self.label,
            margin: self.margin,
            tilt_az: self.tilt_az,
        })
    }
}

/// List of blocks, of which at most [`MAX_BLOCKS`] are stored: validation refuses a longer one.
struct Blocks;

impl Kind for Blocks {
    type Out = Vec<Block>;

    fn expected(&self) -> String {
        "a list of blocks".into()
    }

    fn list<'de, A: SeqAccess<'de>>(&self, mut list: A) -> Result<Vec<Block>, A::Error> {
        let mut blocks = Vec::new();
        while let Some(block) = list.next_element()? {
            blocks.push(block);
            if blocks.len() > MAX_BLOCKS {
                let mut count = blocks.len();
                while list.next_element::<IgnoredAny>()?.is_some() {
                    count += 1;
                }
                return Err(serde::de::Error::custom(format!(
                    "is a list of {count}, expected 1 to {MAX_BLOCKS} blocks"
                )));
            }
        }
        Ok(blocks)
    }
}

#[derive(Default)]
struct BlockFields {
    id: Option<u32>,
    size: Option<[f64; 3]>,
    mass: Option<f64>,
    pos: Option<[f64; 3]>,
    yaw: Option<f64>,
    orientation: Option<[f64; 4]>,
    velocity: [f64; 3],
    spin: [f64; 3],
    fixed: bool,
    friction: Option<f64>,
}

impl Fields for BlockFields {
    const KNOWN: Known = BLOCK;
    const OTHERS: &'static [Known] = &[SCENE, SPRINGS];
    type Out = Block;

    fn read<'de, A: MapAccess<'de>>(&mut self, name: &str, map: &mut A) -> Result<(), A::Error> {
        let numbers = |meaning| Value(Numbers::<3> { meaning });
        match name {
            "id" => self.id = Some(map.next_value_seed(Value(Whole))?),
            "size" => self.size = Some(map.next_value_seed(numbers("the edge lengths in m"))?),
            "mass" => self.mass = Some(map.next_value_seed(Value(Number))?),
            "pos" => self.pos = Some(map.next_value_seed(numbers("x, y and z of the centre in m"))?),
            "yaw" => self.yaw = Some(map.next_value_seed(Value(Number))?),
            "orientation" => {
                let meaning = "a unit quaternion [x, y, z, w]";
                self.orientation = map.next_value_seed(Value(Optional(Numbers { meaning })))?;
            }
            "velocity" => self.velocity = map.next_value_seed(numbers("x, y and z in m/s"))?,
            "spin" => self.spin = map.next_value_seed(numbers("x, y and z in rad/s"))?,
            "fixed" => self.fixed = map.next_value_seed(Value(Flag))?,
            "friction" => self.friction = map.next_value_seed(Value(Optional(Number)))?,
            _ => drop(map.next_value::<IgnoredAny>()?),
        }
        Ok(())
    }

    fn complete(self) -> Result<Block, String> {
        if self.yaw.is_some() && self.orientation.is_some() {
            return Err("`yaw` and `orientation` are both given, expected one of them".into());
        }
        Ok(Block {
            id: required(self.id, "id")?,
            size: required(self.size, "size")?,
            mass: required(self.mass, "mass")?,
            pos: required(self.pos, "pos")?,
            yaw: self.yaw.unwrap_or(0.0),
            orientation: self.orientation,
            velocity: self.velocity,
            spin: self.spin,
            fixed: self.fixed,
            friction: self.friction,
        })
    }
}

impl Fields for Springs {
    const KNOWN: Known = SPRINGS;
    const OTHERS: &'static [Known] = &[SCENE, BLOCK];
    type Out = Self;

    fn read<'de, A: MapAccess<'de>>(&mut self, name: &str, map: &mut A) -> Result<(), A::Error> {
        match name {
            "stiffness" => self.stiffness = map.next_value_seed(Value(Optional(Number)))?,
            "damping" => self.damping = map.next_value_seed(Value(Number))?,
            _ => self.particles = map.next_value_seed(Value(Word::<Particles>(PhantomData)))?,
        }
        Ok(())
    }

    fn complete(self) -> Result<Self, String> {
        Ok(self)
    }
}
