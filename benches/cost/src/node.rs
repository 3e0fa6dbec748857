//! The same workloads in WebAssembly under node, driven from here so that both can be measured in turn.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use serde::Serialize;
use serde::de::DeserializeOwned;
use teeter_physics::{Input, Params};
use teeter_scene::Scene;

use crate::{Fault, Stretch, Workload};

/// A node that has loaded a build of the wasm face. `web/tests/cost.mjs` is its program and says what goes over the line.
#[derive(Debug)]
pub struct Node {
    build: String,
    child: Child,
    to: ChildStdin,
    from: BufReader<ChildStdout>,
}

/// What is sent of a workload.
#[derive(Serialize)]
#[serde(rename_all = "lowercase")]
enum Order<'a> {
    Prepare { scene: &'a Scene, params: &'a Params, inputs: Vec<String>, settle: usize, frames: usize },
    Play(usize),
}

impl Node {
    /// Starts one for a build: `simd128` or `scalar`.
    ///
    /// # Errors
    /// When node cannot be started. A build that is missing shows in the first answer.
    pub fn start(build: &str) -> Result<Self, Fault> {
        let program = concat!(env!("CARGO_MANIFEST_DIR"), "/../../web/tests/cost.mjs");
        let mut command = Command::new("node");
        let spawned = command.args([program, build]).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let mut child = spawned.map_err(|e| format!("node: {e}; tools/setup node installs it"))?;
        let (to, from) = child.stdin.take().zip(child.stdout.take()).ok_or("node has no pipes")?;
        Ok(Self { build: build.to_owned(), child, to, from: BufReader::new(from) })
    }

    /// Settles a workload there; returns its number.
    ///
    /// # Errors
    /// When node gives up.
    pub fn prepare(&mut self, workload: &Workload) -> Result<usize, Fault> {
        let Workload { scene, params, settle, frames, .. } = workload;
        let line = |input: &Input| match input {
            idle if *idle == Input::default() => String::new(),
            input => serde_json::to_string(input).expect("an input can always be written"),
        };
        let inputs = workload.inputs.iter().map(line).collect();
        self.ask(&Order::Prepare { scene, params, inputs, settle: *settle, frames: *frames })
    }

    /// Plays the measured frames of a workload.
    ///
    /// # Errors
    /// When node gives up.
    pub fn play(&mut self, number: usize) -> Result<Stretch, Fault> {
        self.ask(&Order::Play(number))
    }

    fn ask<T: DeserializeOwned>(&mut self, order: &Order) -> Result<T, Fault> {
        let order = serde_json::to_string(order).expect("an order can always be written");
        let mut answer = String::new();
        let sent = writeln!(self.to, "{order}").and_then(|()| self.from.read_line(&mut answer));
        if sent.is_err() || answer.is_empty() {
            return Err(format!("node gave up on the {} build; what it said is above", self.build));
        }
        serde_json::from_str(&answer).map_err(|e| format!("node answered {}: {e}", answer.trim()))
    }
}

impl Drop for Node {
    fn drop(&mut self) {
        // It only waits for the next line.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
