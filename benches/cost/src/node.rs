//! Workloads in WebAssembly under node, driven from here so that native code and node alternate.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use serde::Serialize;
use serde::de::DeserializeOwned;
use teeter_physics::{Input, Params};
use teeter_scene::Scene;

use crate::clock::Measurement;
use crate::error::CostError;
use crate::workload::Workload;

/// Process of node with a build of the WebAssembly binding. `web/tests/cost.mjs` is its program and
/// describes the protocol.
///
/// ```no_run
/// use teeter_cost::{Node, Workload};
///
/// let mut node = Node::start("simd128").expect("node is installed");
/// let number = node.prepare(&Workload::asleep().expect("a valid scene")).expect("a build exists");
/// println!("{} ms", node.play(number).expect("its own state").cpu);
/// ```
#[derive(Debug)]
pub struct Node {
    build: String,
    child: Child,
    to: ChildStdin,
    from: BufReader<ChildStdout>,
}

/// Request to node.
#[derive(Serialize)]
#[serde(rename_all = "lowercase")]
enum Request<'a> {
    Prepare { scene: &'a Scene, params: &'a Params, inputs: Vec<String>, settle: usize, frames: usize },
    Play(usize),
}

impl Node {
    /// Starts node with a build, `simd128` or `scalar`.
    ///
    /// # Errors
    /// When node cannot be started. A missing build fails the first request.
    pub fn start(build: &str) -> Result<Self, CostError> {
        let program = concat!(env!("CARGO_MANIFEST_DIR"), "/../../web/tests/cost.mjs");
        let mut command = Command::new("node");
        let spawned = command.args([program, build]).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let mut child = spawned.map_err(|e| CostError::Node(format!("node: {e}; tools/setup node installs it")))?;
        let (to, from) =
            child.stdin.take().zip(child.stdout.take()).ok_or_else(|| CostError::Node("node has no pipes".into()))?;
        Ok(Self { build: build.to_owned(), child, to, from: BufReader::new(from) })
    }

    /// Settles a workload and returns its number.
    ///
    /// # Errors
    /// When node ends or its answer does not parse.
    pub fn prepare(&mut self, workload: &Workload) -> Result<usize, CostError> {
        let Workload { scene, params, settle, frames, .. } = workload;
        let line = |input: &Input| match input {
            idle if *idle == Input::default() => String::new(),
            input => serde_json::to_string(input).expect("an input serialises"),
        };
        let inputs = workload.inputs.iter().map(line).collect();
        self.request(&Request::Prepare { scene, params, inputs, settle: *settle, frames: *frames })
    }

    /// Plays the measured frames of a workload.
    ///
    /// # Errors
    /// As [`Node::prepare`].
    pub fn play(&mut self, number: usize) -> Result<Measurement, CostError> {
        self.request(&Request::Play(number))
    }

    fn request<T: DeserializeOwned>(&mut self, request: &Request) -> Result<T, CostError> {
        let request = serde_json::to_string(request).expect("a request serialises");
        let mut answer = String::new();
        let sent = writeln!(self.to, "{request}").and_then(|()| self.from.read_line(&mut answer));
        if sent.is_err() || answer.is_empty() {
            return Err(CostError::Node(format!("node ended on the {} build; its message is above", self.build)));
        }
        serde_json::from_str(&answer).map_err(|e| CostError::Node(format!("node answered {}: {e}", answer.trim())))
    }
}

impl Drop for Node {
    fn drop(&mut self) {
        // Node only waits for the next line.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
