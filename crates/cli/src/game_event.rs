//! Events of a game, with their time.

use serde::Serialize;
use serde_json::{Map, Value};
use teeter_game::{Event, Update};
use teeter_physics::StepReport;
use teeter_scene::Scene;

/// Event of a game at the end of a frame. Blocks have the ids of the scene.
#[derive(Debug, Serialize)]
pub struct GameEvent {
    time_s: f64,
    #[serde(flatten)]
    event: Map<String, Value>,
}

impl GameEvent {
    /// Events of an update.
    pub fn of(scene: &Scene, update: &Update<StepReport>) -> Vec<Self> {
        let time_s = update.report.time;
        update.events.iter().map(|event| Self { time_s, event: fields(scene, event) }).collect()
    }

    /// The event as a line: its time, its name, and its fields.
    pub fn line(&self) -> String {
        let field = |(name, value): (&String, &Value)| match (name.as_str(), value) {
            ("event", _) => None,
            (_, Value::String(text)) => Some(format!("{name} {text}")),
            _ => Some(format!("{name} {value}")),
        };
        let fields: Vec<String> = self.event.iter().filter_map(field).collect();
        let name = self.event.get("event").and_then(Value::as_str).unwrap_or_default().replace('_', " ");
        format!("{:9.2} s  {name:12} {}", self.time_s, fields.join(", ")).trim_end().to_owned()
    }
}

/// Fields of an event, with ids instead of body indices.
fn fields(scene: &Scene, event: &Event) -> Map<String, Value> {
    let Ok(Value::Object(mut fields)) = serde_json::to_value(event) else { return Map::new() };
    let id = |index: &Value| {
        let block = index.as_u64().and_then(|index| scene.blocks.get(index as usize));
        block.map_or(index.clone(), |block| block.id.into())
    };
    for (old, new) in [("body", "block"), ("bodies", "blocks")] {
        match fields.remove(old) {
            Some(Value::Array(list)) => fields.insert(new.to_owned(), list.iter().map(id).collect()),
            Some(index) => fields.insert(new.to_owned(), id(&index)),
            None => None,
        };
    }
    // The reason of an illegal command says all that its rule does.
    fields.remove("rule");
    fields
}
