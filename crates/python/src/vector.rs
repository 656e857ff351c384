//! Many worlds for `swanilda.vec`.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use swanilda::Options;
use vector::{
    Action, Arrays, Camera, Declaration, Distribution, Failure, Quantity, Recording, Reset, Scale,
    Target, Variation, WantsEnd,
};

use crate::errors::Error;
use crate::options::{Given, check_time_step, kind_of, recorded};

/// Something that is declared: its kind, and the texts that belong to it.
#[derive(FromPyObject)]
pub struct Named(String, Vec<String>);

impl Named {
    fn one(&self) -> PyResult<String> {
        match &self.1[..] {
            [text] => Ok(text.clone()),
            _ => Err(self.unknown()),
        }
    }

    fn two(&self) -> PyResult<(String, String)> {
        match &self.1[..] {
            [one, other] => Ok((one.clone(), other.clone())),
            _ => Err(self.unknown()),
        }
    }

    fn unknown(&self) -> PyErr {
        PyValueError::new_err(format!("'{}' cannot be used here.", self.0))
    }
}

pub fn quantity(named: &Named) -> PyResult<Quantity> {
    Ok(match named.0.as_str() {
        "joint_position" => Quantity::JointPosition(named.one()?),
        "joint_velocity" => Quantity::JointVelocity(named.one()?),
        "joint_force" => Quantity::JointForce(named.one()?),
        "position" => Quantity::Position(named.one()?),
        "quaternion" => Quantity::Quaternion(named.one()?),
        "velocity" => Quantity::Velocity(named.one()?),
        "property" => named
            .two()
            .map(|(path, name)| Quantity::Property(path, name))?,
        "function" => named
            .two()
            .map(|(path, name)| Quantity::Function(path, name))?,
        "lua" => Quantity::Expression(named.one()?),
        _ => return Err(named.unknown()),
    })
}

pub fn action(named: &Named) -> PyResult<Action> {
    Ok(match named.0.as_str() {
        "target_position" => Action::TargetPosition(named.one()?),
        "target_velocity" => Action::TargetVelocity(named.one()?),
        "target_force" => Action::TargetForce(named.one()?),
        "property" => named
            .two()
            .map(|(path, name)| Action::Property(path, name))?,
        "function" => named
            .two()
            .map(|(path, name)| Action::Function(path, name))?,
        "lua" => Action::Statement(named.one()?),
        _ => return Err(named.unknown()),
    })
}

fn target(named: &Named) -> PyResult<Target> {
    Ok(match named.0.as_str() {
        "property" => named
            .two()
            .map(|(path, name)| Target::Property(path, name))?,
        "position" => Target::Position(named.one()?),
        "orientation" => Target::Orientation(named.one()?),
        "mass" => Target::Mass(named.one()?),
        "friction" => Target::Friction(named.one()?),
        "action_delay" => Target::ActionDelay,
        "lua" => Target::Statement(named.one()?),
        _ => return Err(named.unknown()),
    })
}

/// What is drawn in each episode: target, bounds, and the words of `swanilda.vec` for scale and distribution.
#[derive(FromPyObject)]
struct Varied(Named, Vec<f64>, Vec<f64>, String, String);

fn variation(varied: &Varied) -> PyResult<Variation> {
    let unknown = |word: &str| PyValueError::new_err(format!("'{word}' is not known."));
    Ok(Variation {
        target: target(&varied.0)?,
        low: varied.1.clone(),
        high: varied.2.clone(),
        scale: match varied.3.as_str() {
            "absolute" => Scale::Absolute,
            "offset" => Scale::Offset,
            "factor" => Scale::Factor,
            other => return Err(unknown(other)),
        },
        distribution: match varied.4.as_str() {
            "uniform" => Distribution::Uniform,
            "log_uniform" => Distribution::LogUniform,
            other => return Err(unknown(other)),
        },
    })
}

/// A camera: path, resolution, and whether it draws after each step.
#[derive(FromPyObject)]
struct Viewed(String, Option<[u32; 2]>, bool);

/// What an environment consists of, as `swanilda.vec` passes it.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
struct Declared {
    scene: PathBuf,
    kind: String,
    time_step: Option<f64>,
    observations: Vec<Named>,
    actions: Vec<Named>,
    infos: Vec<Named>,
    cameras: Vec<Viewed>,
    reward: Option<String>,
    terminated: Option<String>,
    prepare: Option<String>,
    begin: Option<String>,
    max_steps: u64,
    steps_per_action: u64,
    variations: Vec<Varied>,
    reset_by: String,
}

impl Declared {
    fn declaration(self, options: Options) -> PyResult<Declaration> {
        let camera = |viewed: Viewed| Camera {
            path: viewed.0,
            resolution: viewed.1,
            each_step: viewed.2,
        };
        Ok(Declaration {
            kind: kind_of(&self.kind)?,
            scene: self.scene,
            time_step: self.time_step,
            options,
            observations: self
                .observations
                .iter()
                .map(quantity)
                .collect::<PyResult<_>>()?,
            actions: self.actions.iter().map(action).collect::<PyResult<_>>()?,
            infos: self.infos.iter().map(quantity).collect::<PyResult<_>>()?,
            cameras: self.cameras.into_iter().map(camera).collect(),
            reward: self.reward,
            terminated: self.terminated,
            prepare: self.prepare,
            begin: self.begin,
            max_steps: self.max_steps,
            steps_per_action: self.steps_per_action,
            variations: self
                .variations
                .iter()
                .map(variation)
                .collect::<PyResult<_>>()?,
            reset: match self.reset_by.as_str() {
                "snapshot" => Reset::Snapshot,
                "start" => Reset::Start,
                "auto" => Reset::Either,
                other => {
                    return Err(PyValueError::new_err(format!(
                        "reset_by is snapshot, start or auto, not '{other}'."
                    )));
                }
            },
        })
    }
}

/// Worlds that step together.
#[pyclass(frozen, module = "swanilda._swanilda")]
pub struct Vector {
    vector: Mutex<vector::Vector>,
    arrays: Arc<Arrays>,
    layout: vector::Layout,
    count: usize,
    signals: Signals,
}

/// What signals of the system raise in Python while worlds are busy, such as ctrl-c.
#[derive(Default)]
struct Signals(Arc<Mutex<Option<PyErr>>>);

impl Signals {
    /// Whether one came.
    fn wants_end(&self) -> WantsEnd {
        let raised = Arc::clone(&self.0);
        Box::new(move || {
            let checked = Python::try_attach(|py| py.check_signals()).unwrap_or(Ok(()));
            let error = checked.err();
            let came = error.is_some();
            if came {
                *raised.lock().unwrap_or_else(PoisonError::into_inner) = error;
            }
            came
        })
    }

    fn raise(&self) -> PyResult<()> {
        let raised = self.0.lock().unwrap_or_else(PoisonError::into_inner).take();
        raised.map_or(Ok(()), Err)
    }
}

#[pymethods]
impl Vector {
    #[new]
    #[pyo3(signature = (declared, count, threads, *, seed=None, params=None, unsafe_functions=true, package_dirs=None, data_dir=None))]
    #[expect(
        clippy::too_many_arguments,
        reason = "keyword arguments, each of which has a default"
    )]
    fn new(
        py: Python<'_>,
        declared: Declared,
        count: usize,
        threads: usize,
        seed: Option<u32>,
        params: Option<BTreeMap<String, String>>,
        unsafe_functions: bool,
        package_dirs: Option<Vec<PathBuf>>,
        data_dir: Option<PathBuf>,
    ) -> PyResult<Self> {
        check_time_step(declared.time_step)?;
        let given = Given {
            seed,
            params,
            unsafe_functions,
            package_dirs,
            data_dir,
            verbosity: None,
            // Worlds are spread over the processors already.
            render_threads: Some(1),
        };
        let options = given.options(py, Some(&declared.scene));
        let declaration = declared.declaration(options)?;
        let signals = Signals::default();
        let wants_end = signals.wants_end();
        let vector = py.detach(|| vector::Vector::new(declaration, count, threads, wants_end));
        signals.raise()?;
        let vector = vector.map_err(|failure| Error::new_err(failure.to_string()))?;
        Ok(Self {
            signals,
            arrays: Arc::clone(vector.arrays()),
            layout: vector.layout().clone(),
            count,
            vector: vector.into(),
        })
    }

    /// How many numbers each observation has.
    #[getter]
    fn observations(&self) -> Vec<usize> {
        self.layout.observations.clone()
    }

    /// How many numbers each info has.
    #[getter]
    fn infos(&self) -> Vec<usize> {
        self.layout.infos.clone()
    }

    /// Width and height of each camera's pictures.
    #[getter]
    fn images(&self) -> Vec<[u32; 2]> {
        self.layout.images.clone()
    }

    #[getter]
    fn has_snapshot(&self) -> bool {
        self.layout.has_snapshot
    }

    /// Simulated seconds of an action.
    #[getter]
    fn action_duration(&self) -> f64 {
        self.layout.action_duration
    }

    /// The numbers of all worlds by name, for `numpy.asarray`; pictures by their place.
    #[pyo3(signature = (name, image=0))]
    fn array(&self, name: &str, image: usize) -> PyResult<Array> {
        let (arrays, count) = (&self.arrays, self.count);
        let numbers =
            |array: &vector::Array<f64>| (array.address(), vec![count, array.width()], "<f8");
        let flags = |array: &vector::Array<u8>| (array.address(), vec![count], "|b1");
        let (address, shape, kind) = match name {
            "actions" => numbers(&arrays.actions),
            "observations" => numbers(&arrays.observations),
            "infos" => numbers(&arrays.infos),
            "rewards" => (arrays.rewards.address(), vec![count], "<f8"),
            "terminated" => flags(&arrays.terminated),
            "truncated" => flags(&arrays.truncated),
            "resets" => flags(&arrays.resets),
            "failed" => flags(&arrays.failed),
            "images" if image < arrays.images.len() => {
                let [width, height] = self.layout.images[image].map(scene::numbers::place);
                let address = arrays.images[image].address();
                (address, vec![count, height, width, 3], "|u1")
            }
            _ => {
                return Err(PyValueError::new_err(format!(
                    "there is no array '{name}'."
                )));
            }
        };
        Ok(Array {
            _arrays: Arc::clone(arrays),
            address,
            shape,
            kind,
        })
    }

    /// Begins an episode in worlds, with a seed where there is one; the worlds that failed, and why.
    fn begin(
        &self,
        py: Python<'_>,
        worlds: Vec<(usize, Option<u32>)>,
    ) -> PyResult<Vec<(usize, String)>> {
        let failures = py.detach(|| self.locked().begin(&worlds));
        self.signals.raise()?;
        Ok(pairs(failures))
    }

    /// Steps all worlds; those that failed, and why.
    fn step(&self, py: Python<'_>) -> PyResult<Vec<(usize, String)>> {
        let stepped = py.detach(|| self.locked().step());
        self.signals.raise()?;
        stepped.map(pairs).map_err(|(world, place)| {
            PyValueError::new_err(format!(
                "action {place} of world {world} is no finite number; nothing was stepped"
            ))
        })
    }

    /// Records the next episodes of worlds in files, with the images of vision sensors where that is true; the files that cannot be written.
    fn record(
        &self,
        py: Python<'_>,
        episodes: Vec<(usize, PathBuf, bool)>,
    ) -> Vec<(usize, String)> {
        let recording = |(world, path, images)| Recording {
            world,
            path,
            recorded: recorded(images),
        };
        let recordings: Vec<Recording> = episodes.into_iter().map(recording).collect();
        py.detach(|| pairs(self.locked().record(&recordings)))
    }

    /// Completes the recordings of worlds; the files that could not be written.
    fn finish_recordings(&self, py: Python<'_>, worlds: Vec<usize>) -> Vec<(usize, String)> {
        py.detach(|| pairs(self.locked().finish_recordings(&worlds)))
    }

    /// Draws the pictures of a camera in all worlds; those that failed, and why.
    fn draw(&self, py: Python<'_>, camera: usize) -> PyResult<Vec<(usize, String)>> {
        if camera >= self.layout.images.len() {
            return Err(PyValueError::new_err(format!(
                "there is no camera {camera}."
            )));
        }
        let failures = py.detach(|| self.locked().draw(camera));
        self.signals.raise()?;
        Ok(pairs(failures))
    }
}

impl Vector {
    fn locked(&self) -> std::sync::MutexGuard<'_, vector::Vector> {
        self.vector.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn pairs(failures: Vec<Failure>) -> Vec<(usize, String)> {
    let pair = |failure: Failure| (failure.world, failure.reason);
    failures.into_iter().map(pair).collect()
}

/// Numbers of all worlds as numpy sees them, in place.
#[pyclass(frozen, module = "swanilda._swanilda")]
pub struct Array {
    /// What the address leads to.
    _arrays: Arc<Arrays>,
    address: usize,
    shape: Vec<usize>,
    kind: &'static str,
}

#[pymethods]
impl Array {
    /// What numpy needs to know.
    #[getter]
    fn __array_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let facts = PyDict::new(py);
        facts.set_item("version", 3)?;
        facts.set_item("shape", pyo3::types::PyTuple::new(py, &self.shape)?)?;
        facts.set_item("typestr", self.kind)?;
        facts.set_item("data", (self.address, false))?;
        Ok(facts)
    }
}
