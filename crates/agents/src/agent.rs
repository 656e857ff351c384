//! A simulator that a client works with.

use std::collections::BTreeMap;
use std::path::Path;
use std::time::Duration;

use mcp::{About, Answer, Contents, NotFound, Progress, Resource, Service, Template, Tool};
use permissions::Permissions;
use scene::Data;
use serde_json::Value;
use simulator::{Error, Options, ScriptKind, ScriptRef, Simulator, Snapshot};

use crate::arguments::{Arguments, check};
use crate::clock::Deadline;
use crate::console::{Lines, Recorder};
use crate::resources;
use crate::tools::scene::Row;
use crate::tools::{self, Group};
use crate::values::{text_field, without_place};

/// For the models of clients that connect.
const INSTRUCTIONS: &str = "A headless simulator of robots (CoppeliaSim's Lua API, module `sim`). Begin with `scene`. Objects are named by paths \
such as /Robot/Joint, or by handles such as #12; quantities by PATH.PROPERTY (/Cuboid.mass, /Ball.position[3], #12.mass) or by Lua expressions. \
Time stands still between calls: `step` and `run_until` advance it, and return samples of what they `watch`. Lengths are in metres, angles in \
radians, times in seconds, forces in newtons. Before trying something, `snapshot`; to compare ideas, `compare_variants`. `api` explains functions of `sim`.";

/// How simulators of an agent are made.
#[derive(Clone)]
pub struct Setting {
    /// Of each simulator; their permissions are those of scripts and of the tools.
    pub options: Options,
    /// Longest time that a call may take by the wall clock.
    pub time_limit: Duration,
    /// Whether new scenes are empty, instead of the default scene.
    pub is_empty: bool,
}

/// A simulator, and what its client has seen and kept of it.
pub struct Agent {
    pub(crate) setting: Setting,
    pub(crate) sim: Simulator,
    sandbox: ScriptRef,
    pub(crate) lines: Lines,
    /// The scene as it was last seen.
    pub(crate) seen: Option<Vec<Row>>,
    pub(crate) snapshots: BTreeMap<String, Snapshot>,
    tools: Vec<Tool>,
    /// Of the call that is made.
    pub(crate) progress: Progress,
}

impl Agent {
    /// An agent with the default scene, or with a scene of a file, which is read whatever the permissions are.
    ///
    /// # Errors
    /// When it cannot be read.
    pub fn new(setting: Setting, scene: Option<&Path>) -> Result<Self, Error> {
        let (mut sim, lines) = made(&setting, scene);
        match scene {
            Some(scene) => sim.open(scene, ScriptKind::Customization)?,
            None if !setting.is_empty => sim.add_default_objects()?,
            None => {}
        }
        let sandbox = helped(&mut sim)?;
        Ok(Self {
            setting,
            sim,
            sandbox,
            lines,
            seen: None,
            progress: Progress::default(),
            snapshots: BTreeMap::new(),
            tools: tools::GROUPS
                .iter()
                .flat_map(|group| (group.tools)())
                .collect(),
        })
    }

    /// Puts another simulator in the place of this one, filled by `fill`.
    pub(crate) fn replace(
        &mut self,
        scene: Option<&Path>,
        fill: impl FnOnce(&mut Simulator) -> Result<(), String>,
    ) -> Result<(), String> {
        let (mut sim, lines) = made(&self.setting, scene);
        fill(&mut sim)?;
        let sandbox = helped(&mut sim).map_err(|error| error.to_string())?;
        (self.sim, self.sandbox, self.lines) = (sim, sandbox, lines);
        self.snapshots.clear();
        self.seen = None;
        Ok(())
    }

    /// Sets the length of a simulation step of the present scene, seconds.
    pub fn set_step(&mut self, seconds: f64) {
        let mut scene = self.sim.scene_mut();
        scene.modify_settings(|settings| settings.time_step = seconds);
    }

    pub(crate) fn permissions(&self) -> &Permissions {
        &self.setting.options.permissions
    }

    /// Calls a function of the helper; the first value that it returns.
    pub(crate) fn helper(&mut self, function: &str, args: &[Data]) -> Result<Data, String> {
        let name = format!("package.loaded.swanilda_agents.{function}");
        let results = self.sim.call(&self.sandbox, &name, args);
        let results = results.map_err(|error| without_place(&error.to_string()))?;
        let first = results.into_iter().next().unwrap_or(Data::Nil);
        match text_field(&first, "failed") {
            Some(error) => Err(tools::with_near_objects(self, &without_place(&error))),
            None => Ok(first),
        }
    }

    fn dispatch(&mut self, tool: &str, arguments: &Value) -> Result<Answer, String> {
        let known = self.tools.iter().find(|known| known.name == tool);
        let known = known.ok_or_else(|| format!("there is no tool {tool}"))?;
        check(&known.arguments, arguments)?;
        let group: Option<&Group> = tools::GROUPS
            .iter()
            .find(|group| (group.tools)().iter().any(|other| other.name == tool));
        let group = group.ok_or_else(|| format!("there is no tool {tool}"))?;
        (group.call)(self, tool, Arguments::new(arguments))
    }
}

/// A simulator with an empty scene.
fn made(setting: &Setting, scene: Option<&Path>) -> (Simulator, Lines) {
    let lines = Lines::default();
    let options = Options {
        package_dirs: scene.map(Simulator::folder_of_scene).into_iter().collect(),
        ..setting.options.clone()
    };
    let builder = Simulator::builder()
        .options(options)
        .console(Box::new(Recorder::new(&lines)));
    (builder.observed().build(), lines)
}

fn helped(sim: &mut Simulator) -> Result<ScriptRef, Error> {
    sim.add_script(
        ScriptKind::Sandbox,
        "swanilda mcp",
        include_bytes!("helper.lua"),
    )
}

impl Service for Agent {
    fn about(&self) -> About {
        About {
            name: "swanilda",
            title: "Swanilda, a robot simulator",
            version: env!("CARGO_PKG_VERSION"),
            instructions: INSTRUCTIONS.to_owned(),
        }
    }

    fn tools(&self) -> &[Tool] {
        &self.tools
    }

    fn call(&mut self, tool: &str, arguments: &Value, progress: &Progress) -> Answer {
        self.progress = progress.clone();
        let deadline = Deadline::start(&self.setting.options.stop, self.setting.time_limit);
        let answer = self.dispatch(tool, arguments);
        let is_late = deadline.end();
        let answer = answer.unwrap_or_else(Answer::error);
        if is_late {
            answer.and_text(&self.late())
        } else {
            answer
        }
    }

    fn resources(&mut self) -> Vec<Resource> {
        resources::all(self)
    }

    fn templates(&self) -> Vec<Template> {
        resources::templates()
    }

    fn read(&mut self, uri: &str) -> Result<Contents, NotFound> {
        resources::read(self, uri)
    }
}

impl Agent {
    fn late(&self) -> String {
        format!(
            "The call was ended after {} s of wall-clock time. Ask for less at a time; if a script does not return, it has a loop without end.",
            self.setting.time_limit.as_secs()
        )
    }
}
