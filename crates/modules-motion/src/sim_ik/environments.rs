//! Environments: a script owns those that it creates, and all scripts may use them.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::rc::{Rc, Weak};

use api_macro::api;
use kinematics::Environment;

use super::{ApiError, ApiFn, Cx, Result, busy, functions, refused, with};
use ik::SceneLinks;
use script::{Bytes, Number};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    create_environment,
    erase_environment,
    duplicate_environment,
    save,
    load
];

/// An environment with its connection to the scene.
#[derive(Debug, Clone)]
pub(super) struct Held {
    pub env: Environment,
    pub links: SceneLinks,
}

/// All environments of a simulator, by handle.
#[derive(Default)]
struct Known {
    environments: RefCell<BTreeMap<i64, Weak<RefCell<Held>>>>,
    last: Cell<i64>,
}

/// Those of a script. They end with it.
#[derive(Default)]
struct Owned(RefCell<BTreeMap<i64, Rc<RefCell<Held>>>>);

fn missing() -> ApiError {
    refused("environment does not exist.")
}

/// # Errors
/// When there is no such environment.
pub(super) fn environment(cx: &Cx, handle: i64) -> Result<Rc<RefCell<Held>>> {
    let known = cx.module_state::<Known>();
    let environments = known.environments.borrow();
    environments
        .get(&handle)
        .and_then(Weak::upgrade)
        .ok_or_else(missing)
}

fn add(cx: &Cx, held: Held) -> i64 {
    let known = cx.module_state::<Known>();
    let handle = known.last.get() + 1;
    known.last.set(handle);
    let held = Rc::new(RefCell::new(held));
    known
        .environments
        .borrow_mut()
        .retain(|_, held| held.strong_count() > 0);
    known
        .environments
        .borrow_mut()
        .insert(handle, Rc::downgrade(&held));
    cx.script_state::<Owned>()
        .0
        .borrow_mut()
        .insert(handle, held);
    handle
}

/// A new environment, without objects. It ends with the script.
///
/// @param flags not used
/// @return environmentHandle the environment
#[api("simIK.createEnvironment")]
fn create_environment(cx: &mut Cx, #[default(0)] flags: Number) -> Result<i64> {
    let _ = flags;
    let made = cx.module_state::<Known>().last.get();
    let seed = (u64::from(cx.options().seed) << 32) | (made as u64 & 0xffff_ffff);
    Ok(add(
        cx,
        Held {
            env: Environment::new(seed),
            links: SceneLinks::default(),
        },
    ))
}

/// Removes an environment.
///
/// @param environmentHandle the environment
#[api("simIK.eraseEnvironment")]
fn erase_environment(cx: &mut Cx, environment_handle: Number) -> Result<()> {
    let held = environment(cx, environment_handle.0)?;
    held.try_borrow_mut().map(drop).map_err(|_| busy())?;
    cx.module_state::<Known>()
        .environments
        .borrow_mut()
        .remove(&environment_handle.0);
    cx.script_state::<Owned>()
        .0
        .borrow_mut()
        .remove(&environment_handle.0);
    Ok(())
}

/// A copy of an environment, with all objects, groups and the connection to the scene. Handles of objects, groups and elements are the same in both.
///
/// @param environmentHandle the environment
/// @return duplicateEnvHandle the copy
#[api("simIK.duplicateEnvironment")]
fn duplicate_environment(cx: &mut Cx, environment_handle: Number) -> Result<i64> {
    let copy = with(cx, environment_handle.0, |held| Ok(held.clone()))?;
    Ok(add(cx, copy))
}

/// An environment as bytes, in a format of our own. Dependencies by functions and the connection to the scene are not part of it.
///
/// @param environmentHandle the environment
/// @return data for simIK.load
#[api("simIK.save")]
fn save(cx: &Cx, environment_handle: Number) -> Result<Bytes> {
    with(cx, environment_handle.0, |held| held.env.to_bytes()).map(Bytes)
}

/// Replaces everything in an environment by what simIK.save wrote.
///
/// @param environmentHandle the environment
/// @param data from simIK.save
#[api("simIK.load")]
fn load(cx: &mut Cx, environment_handle: Number, data: Bytes) -> Result<()> {
    with(cx, environment_handle.0, |held| {
        held.env.read_bytes(&data.0)?;
        held.links = SceneLinks::default();
        Ok(())
    })
}
