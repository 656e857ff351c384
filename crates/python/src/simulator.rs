//! A simulator as an object of Python.

use std::collections::BTreeMap;
use std::net::{Ipv4Addr, TcpListener};
use std::path::PathBuf;
use std::rc::Rc;
use std::time::Duration;

use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyTuple};
use scene::Handle;
use script::wall_clock;
use swanilda::{Channels, Options, ScriptKind, SimulationState, Viewer};

use crate::errors::{self, Error};
use crate::interruption;
use crate::module::Module;
use crate::options::{Given, check_time_step, kind_of};
use crate::quantities::Quantities;
use crate::script::PythonScript;
use crate::vector::Named;
use crate::worlds::branches::{NOT_SHOWN, Snapshot};
use crate::worlds::making::made;
use crate::worlds::{self, Shared, World};

/// Steps between two checks of signals, such as that of ctrl-c; fewer where they take longer than [`TIME_AT_ONCE`].
const STEPS_AT_ONCE: u64 = 32;
const TIME_AT_ONCE: Duration = Duration::from_millis(50);

/// A simulator, of the thread that makes it.
#[pyclass(subclass, frozen, module = "swanilda._swanilda")]
pub struct Simulator {
    number: u64,
}

#[pymethods]
impl Simulator {
    #[new]
    #[pyo3(signature = (scene=None, *, seed=None, params=None, kind="customization", time_step=None, empty=false, quiet=false,
        unsafe_functions=true, package_dirs=None, data_dir=None, verbosity=None, render_threads=None, _branch=None))]
    #[expect(
        clippy::too_many_arguments,
        reason = "keyword arguments, each of which has a default"
    )]
    fn new(
        py: Python<'_>,
        scene: Option<PathBuf>,
        seed: Option<u32>,
        params: Option<BTreeMap<String, String>>,
        kind: &str,
        time_step: Option<f64>,
        empty: bool,
        quiet: bool,
        unsafe_functions: bool,
        package_dirs: Option<Vec<PathBuf>>,
        data_dir: Option<PathBuf>,
        verbosity: Option<i64>,
        render_threads: Option<usize>,
        _branch: Option<u64>,
    ) -> PyResult<Self> {
        if let Some(number) = _branch {
            return Ok(Self { number });
        }
        interruption::watch(py)?;
        let kind = kind_of(kind)?;
        check_time_step(time_step)?;
        let given = Given {
            seed,
            params,
            unsafe_functions,
            package_dirs,
            data_dir,
            verbosity,
            render_threads,
        };
        let options = given.options(py, scene.as_deref());
        let this = Self::filled(py, options, quiet, scene, kind, empty)?;
        if let Some(step) = time_step {
            worlds::get(this.number)?
                .borrow()?
                .scene_mut()
                .modify_settings(|settings| settings.time_step = step);
        }
        Ok(this)
    }

    /// Steps of the simulation; returns how many ran, fewer when a script stopped or paused it.
    #[pyo3(signature = (count=1))]
    fn step(&self, py: Python<'_>, count: u64) -> PyResult<u64> {
        let world = self.world()?;
        if count > 0 {
            Self::check_running(&world)?;
        }
        let number = self.number;
        let mut left = count;
        while left > 0 && world.main.caller.state().is_advancing() {
            let now = left.min(STEPS_AT_ONCE);
            let ran = interruption::detached(py, || steps_of(number, now))?;
            left -= ran.min(left);
            world.raise()?;
            py.check_signals()?;
        }
        Ok(count - left)
    }

    /// One iteration of the loop, with a step if the simulation runs.
    fn iterate(&self, py: Python<'_>) -> PyResult<()> {
        self.serve(py, 0.0)
    }

    /// One iteration of the loop, then browsers that show the simulator are served, waiting up to `timeout` seconds for what they ask.
    #[pyo3(name = "_serve")]
    fn serve(&self, py: Python<'_>, timeout: f64) -> PyResult<()> {
        let timeout = Duration::try_from_secs_f64(timeout).unwrap_or_default();
        let number = self.number;
        interruption::detached(py, || -> PyResult<()> {
            let world = worlds::get(number)?;
            let mut simulator = world.borrow()?;
            simulator.iterate();
            world.show(&mut simulator, timeout);
            Ok(())
        })?;
        self.world()?.raise()
    }

    /// One iteration of the loop, of which browsers are not shown anything; whether a step ran.
    fn _advance(&self, py: Python<'_>) -> PyResult<bool> {
        let stepped = self.detached(py, |simulator| {
            let before = simulator.steps();
            simulator.iterate();
            simulator.steps() != before
        })?;
        self.world()?.raise()?;
        Ok(stepped)
    }

    /// Does what browsers ask for, waiting up to `timeout` seconds for that, and shows them what changed; whether there can be some.
    fn _attend(&self, py: Python<'_>, timeout: f64) -> PyResult<bool> {
        let timeout = Duration::try_from_secs_f64(timeout).unwrap_or_default();
        let number = self.number;
        interruption::detached(py, || -> PyResult<()> {
            let world = worlds::get(number)?;
            world.show(&mut *world.borrow()?, timeout);
            Ok(())
        })?;
        let world = self.world()?;
        world.raise()?;
        Ok(world.viewer.borrow().is_some())
    }

    /// Shows the simulator to browsers on this machine; returns the address of the page.
    fn _view(&self, port: u16) -> PyResult<String> {
        let world = self.world()?;
        if world.has_branches() {
            return Err(Error::new_err(NOT_SHOWN));
        }
        if world.viewer.borrow().is_none() {
            let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port))?;
            let mut simulator = world.borrow()?;
            let mut viewer = Viewer::start(&simulator, listener, false)?;
            viewer.attend(&mut simulator, Duration::ZERO);
            world.viewer.replace(Some(viewer));
        }
        Ok(world
            .viewer
            .borrow()
            .as_ref()
            .map(Viewer::url)
            .unwrap_or_default())
    }

    /// Records what is shown after each step from now on in a file.
    fn _record(&self, path: PathBuf, images: bool) -> PyResult<()> {
        self.world()?.record(path, images)
    }

    /// Completes the file of `record`, if there is one.
    fn end_recording(&self) -> PyResult<()> {
        self.world()?.finish_recording()
    }

    /// Starts the simulation, or resumes it.
    fn start(&self, py: Python<'_>) -> PyResult<()> {
        self.run(py, swanilda::Simulator::start)
    }

    fn pause(&self, py: Python<'_>) -> PyResult<()> {
        self.run(py, swanilda::Simulator::pause)
    }

    /// Ends the simulation, with all its clean-up.
    fn stop(&self, py: Python<'_>) -> PyResult<()> {
        self.run(py, swanilda::Simulator::stop)
    }

    /// The whole simulator as it is now, for `restore`.
    fn snapshot(&self, py: Python<'_>) -> PyResult<Snapshot> {
        let snapshot = self.detached(py, swanilda::Simulator::snapshot)?;
        Ok(Snapshot(snapshot.map_err(|error| errors::plain(&error))?))
    }

    /// Brings back what the simulator was.
    fn restore(&self, py: Python<'_>, snapshot: &Snapshot) -> PyResult<()> {
        self.world()?.check_not_recorded()?;
        let restored = self.detached(py, |simulator| simulator.restore(&snapshot.0))?;
        restored.map_err(|error| errors::plain(&error))
    }

    /// What is read and written in the scene, found once.
    fn _quantities(&self, observations: Vec<Named>, actions: Vec<Named>) -> PyResult<Quantities> {
        Quantities::new(self.number, &observations, &actions)
    }

    /// The numbers of branches from the present moment on.
    fn _branch(&self, py: Python<'_>, count: usize) -> PyResult<Vec<u64>> {
        let number = self.number;
        py.detach(|| worlds::get(number)?.branch(count))
    }

    /// Ends the simulator; its scripts clean up.
    fn close(&self, py: Python<'_>) -> PyResult<()> {
        let number = self.number;
        py.detach(|| worlds::close(number))
    }

    /// Whether it can be used: by this thread, and not closed.
    #[getter]
    fn is_open(&self) -> bool {
        worlds::find(self.number).is_ok()
    }

    /// Simulated time, seconds.
    #[getter]
    fn time(&self) -> PyResult<f64> {
        Ok(self.world()?.main.caller.time())
    }

    /// Steps since the start.
    #[getter]
    fn steps(&self) -> PyResult<u64> {
        Ok(self.world()?.main.caller.steps())
    }

    /// The hash of what scripts can observe, 64 bits: simulators in the same state have the same one.
    fn state_hash(&self, py: Python<'_>) -> PyResult<u64> {
        self.detached(py, |simulator| simulator.state_hash())
    }

    /// Number of uncaught script errors.
    #[getter]
    fn errors(&self) -> PyResult<u64> {
        Ok(self.world()?.main.caller.errors())
    }

    /// `stopped`, `paused` or `running`.
    #[getter]
    fn state(&self) -> PyResult<&'static str> {
        Ok(match self.world()?.main.caller.state() {
            SimulationState::Stopped => "stopped",
            SimulationState::Paused => "paused",
            _ => "running",
        })
    }

    /// Whether the end of the simulation was requested, or has come.
    #[getter]
    fn _is_stopping(&self) -> PyResult<bool> {
        Ok(self.world()?.main.caller.state().is_stopping())
    }

    /// A module, as scripts get it; in the name of the script with that handle, if there is one.
    #[pyo3(signature = (name, script=None))]
    fn require(&self, py: Python<'_>, name: &str, script: Option<i64>) -> PyResult<Module> {
        Module::require(py, self.number, script, name)
    }

    /// Adds a script in Python; returns its handle. `create` gets the handle each time the script starts, and returns the object whose
    /// functions are called.
    fn _add_python_script(
        &self,
        py: Python<'_>,
        kind: &str,
        name: String,
        create: Py<PyAny>,
    ) -> PyResult<i64> {
        let kind = kind_of(kind)?;
        let shared = SendRc(self.number);
        let added = self.detached(py, move |simulator| {
            let shared = shared.shared()?;
            let create = Rc::new(create);
            let script = simulator.add_native_script(kind, &name, move |caller| {
                PythonScript::start(caller, &create, &shared)
            });
            script
                .map(|script| script.handle())
                .map_err(|error| errors::plain(&error))
        })?;
        self.world()?.raise()?;
        added
    }

    /// Adds a script in Lua; returns its handle.
    fn _add_lua_script(
        &self,
        py: Python<'_>,
        kind: &str,
        name: String,
        code: Vec<u8>,
    ) -> PyResult<i64> {
        let kind = kind_of(kind)?;
        let added = self.detached(py, move |simulator| {
            simulator.add_script(kind, &name, &code).map(|s| s.handle())
        })?;
        self.world()?.raise()?;
        added.map_err(|error| errors::plain(&error))
    }

    /// Calls a global function of a script.
    #[pyo3(signature = (script, function, *args))]
    fn _call_script(
        &self,
        py: Python<'_>,
        script: i64,
        function: &str,
        args: &Bound<'_, PyTuple>,
    ) -> PyResult<Py<PyAny>> {
        let world = self.world()?;
        let mut all = vec![
            swanilda::scene::Data::text(function),
            swanilda::scene::Data::Int(script),
        ];
        all.extend(crate::convert::arguments(args, &world.main.callables)?);
        let number = self.number;
        let result = interruption::detached(py, || -> PyResult<_> {
            let world = worlds::get(number)?;
            let call = world.main.caller.function("sim.callScriptFunction");
            Ok(world.main.caller.call(&call, &all))
        })?;
        world.raise()?;
        if result.is_err() {
            // Ctrl-c comes before what it has led to.
            py.check_signals()?;
        }
        crate::convert::results(
            py,
            result.map_err(|error| errors::in_function(function, &error))?,
        )
    }

    /// Width, height and the bytes of a picture, three for each point, from its upper left corner: of a camera or vision sensor, or of the
    /// whole scene.
    #[pyo3(signature = (camera=None, resolution=None))]
    fn _picture<'py>(
        &self,
        py: Python<'py>,
        camera: Option<i64>,
        resolution: Option<[u32; 2]>,
    ) -> PyResult<(usize, usize, Bound<'py, PyBytes>)> {
        let from = camera
            .map(|raw| {
                Handle::from_raw(raw).ok_or_else(|| Error::new_err("object does not exist."))
            })
            .transpose()?;
        let picture = self.detached(py, move |simulator| {
            simulator.picture(from, resolution, Channels::COLOUR)
        })?;
        let picture = picture.map_err(|error| errors::plain(&error))?;
        let [width, height] = picture.resolution.map(|side| side as usize);
        let rows: Vec<u8> = picture
            .colour
            .chunks(3 * width.max(1))
            .rev()
            .flatten()
            .copied()
            .collect();
        Ok((width, height, PyBytes::new(py, &rows)))
    }

    #[getter]
    fn _number(&self) -> u64 {
        self.number
    }
}

/// The way of a simulator's number to another closure on the same thread.
struct SendRc(u64);

impl SendRc {
    fn shared(&self) -> PyResult<Rc<Shared>> {
        Ok(Rc::clone(&worlds::get(self.0)?.shared))
    }
}

fn steps_of(number: u64, count: u64) -> PyResult<u64> {
    let world = worlds::get(number)?;
    let mut simulator = world.borrow()?;
    let (mut ran, began) = (0, wall_clock::now());
    while ran < count
        && began.elapsed() < TIME_AT_ONCE
        && simulator.state().is_advancing()
        && world.shared.exception.borrow().is_none()
    {
        let before = simulator.steps();
        simulator.iterate();
        world.show(&mut simulator, Duration::ZERO);
        // In real time, an iteration may be too early for a step.
        ran += u64::from(simulator.steps() != before);
    }
    Ok(ran)
}

impl Simulator {
    fn world(&self) -> PyResult<Rc<World>> {
        worlds::get(self.number)
    }

    fn filled(
        py: Python<'_>,
        options: Options,
        quiet: bool,
        scene: Option<PathBuf>,
        kind: ScriptKind,
        empty: bool,
    ) -> PyResult<Self> {
        let number = py.detach(move || {
            let world = made(options, quiet);
            let number = world.number;
            worlds::add(world);
            number
        });
        let this = Self { number };
        let opened = this.detached(py, move |simulator| match scene {
            Some(scene) => simulator.open(&scene, kind),
            None if empty => Ok(()),
            None => simulator.add_default_objects(),
        })?;
        if let Err(error) = opened {
            this.close(py)?;
            return Err(errors::plain(&error));
        }
        this.world()?.raise()?;
        Ok(this)
    }

    fn check_running(world: &World) -> PyResult<()> {
        match world.main.caller.state() {
            SimulationState::Stopped => Err(Error::new_err(
                "the simulation is stopped: start() it first.",
            )),
            SimulationState::Paused => Err(Error::new_err(
                "the simulation is paused: start() resumes it.",
            )),
            _ => Ok(()),
        }
    }

    /// Lets other threads of Python run meanwhile.
    fn detached<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&mut swanilda::Simulator) -> T + Send,
    ) -> PyResult<T> {
        let number = self.number;
        interruption::detached(py, move || -> PyResult<T> {
            let world = worlds::get(number)?;
            let mut simulator = world.borrow()?;
            Ok(work(&mut simulator))
        })
    }

    fn run(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&mut swanilda::Simulator) + Send,
    ) -> PyResult<()> {
        self.detached(py, work)?;
        self.world()?.raise()
    }
}

impl Drop for Simulator {
    fn drop(&mut self) {
        // Of another thread it ends with that thread.
        let number = self.number;
        Python::try_attach(|py| py.detach(|| drop(worlds::close(number))));
    }
}
