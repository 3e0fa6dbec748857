//! Rapier for a program in another language: a request a line on the standard input, an answer a
//! line on the standard output, both JSON.
//!
//! The argument is the name of a setting, `default`, `best` or `stiff`. The first line out is
//! `{"details": "..."}`. Requests are `{"load": SCENE}`, `{"gravity": [x, y, z]}` and
//! `{"step": {"seconds": s, "forces": [[block, x, y, z], ...]}}`, in SI units.
//!
//! The answer to a scene or a step is `{"poses": [x, y, z, qx, qy, qz, qw, ...], "cpu_s": s}` with
//! the CPU time of all steps so far, to others `{}`, and `{"error": "..."}` where a request cannot
//! be carried out.

use std::io::{self, BufRead, Write};
use std::process::ExitCode;

use glam::DVec3;
use serde::Deserialize;
use serde_json::{Value, json};
use teeter_peers::clock::thread_seconds;
use teeter_peers::engine::Engine;
use teeter_peers::rapier::{Rapier, SETTINGS, Setting};
use teeter_scene::Scene;

/// Request of a line.
#[derive(Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
enum Request {
    Load(Value),
    Gravity([f64; 3]),
    Step { seconds: f64, forces: Vec<(usize, f64, f64, f64)> },
}

/// Longest time of a request, s.
const MAX_SECONDS: f64 = 3600.0;

/// Engine with the number of its blocks and the CPU time of its steps.
struct Session {
    setting: Setting,
    engine: Option<(Rapier, usize)>,
    cpu_s: f64,
}

impl Session {
    fn answer(&mut self, line: &str) -> Result<Value, String> {
        let request: Request = serde_json::from_str(line).map_err(|error| error.to_string())?;
        match request {
            Request::Load(scene) => {
                let scene = Scene::from_json(&scene.to_string()).map_err(|error| error.to_string())?;
                self.engine = Some((Rapier::new(&scene, self.setting), scene.blocks.len()));
                self.state()
            }
            Request::Gravity(gravity) => {
                self.engine.as_mut().ok_or("no scene is loaded")?.0.set_gravity(gravity.into());
                Ok(json!({}))
            }
            Request::Step { seconds, forces } => {
                let (engine, blocks) = self.engine.as_mut().ok_or("no scene is loaded")?;
                if !(0.0..=MAX_SECONDS).contains(&seconds) || forces.iter().any(|force| force.0 >= *blocks) {
                    return Err(format!("expected 0 to {MAX_SECONDS} s, and forces on blocks below {blocks}"));
                }
                let forces: Vec<(usize, DVec3)> =
                    forces.into_iter().map(|(block, x, y, z)| (block, DVec3::new(x, y, z))).collect();
                let steps = (seconds / engine.step_seconds()).round() as usize;
                let start = thread_seconds();
                (0..steps).for_each(|_| engine.step(&forces));
                self.cpu_s += thread_seconds() - start;
                self.state()
            }
        }
    }

    fn state(&self) -> Result<Value, String> {
        let (engine, blocks) = self.engine.as_ref().ok_or("no scene is loaded")?;
        let pose = |block| {
            let (p, q) = engine.pose(block);
            [p.x, p.y, p.z, q.x, q.y, q.z, q.w]
        };
        // JSON has no numbers that are not finite: a block that ran away is far below the floor.
        let number = |value: f64| if value.is_finite() { value } else { -1e9 };
        let poses: Vec<f64> = (0..*blocks).flat_map(pose).map(number).collect();
        Ok(json!({ "poses": poses, "cpu_s": self.cpu_s }))
    }
}

fn main() -> ExitCode {
    let name = std::env::args().nth(1).unwrap_or_else(|| "best".to_owned());
    let Some(setting) = SETTINGS.into_iter().find(|setting| setting.name == name) else {
        eprintln!("rapier-lines: no setting is called {name}, expected default, best or stiff");
        return ExitCode::from(2);
    };
    match serve(setting) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("rapier-lines: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Answers lines until the input ends.
fn serve(setting: Setting) -> io::Result<()> {
    let mut session = Session { setting, engine: None, cpu_s: 0.0 };
    let mut out = io::stdout().lock();
    let mut send = |answer: &Value| writeln!(out, "{answer}").and_then(|()| out.flush());
    send(&json!({ "details": format!("version 0.36.1, {}", setting.details()) }))?;
    for line in io::stdin().lock().lines() {
        send(&session.answer(&line?).unwrap_or_else(|error| json!({ "error": error })))?;
    }
    Ok(())
}
