//! Properties of script objects and detached scripts.

use super::access::{Accessor, Subject, object_properties, subject_properties};
use crate::error::ApiResult;
use crate::host::Detached;
use scene::object::script_object::{ExecutionPriority, ScriptObject};
use scene::{Field, SceneResult};

/// Suffix of an add-on's log name that `sim.getStringProperty(.., 'scriptName')` omits.
const ADD_ON_SUFFIX: &str = "@addOnScript";

impl Subject<'_> {
    /// Reads text or flags, wherever the script keeps them.
    fn read_script<R>(
        &self,
        object: impl FnOnce(&ScriptObject) -> R,
        detached: impl FnOnce(&Detached) -> R,
    ) -> ApiResult<R> {
        let script = self.script()?;
        match script.object {
            Some(handle) => Ok(object(self.sim.scene.borrow().object(handle)?.script()?)),
            None => Ok(detached(&script.detached.borrow())),
        }
    }

    /// Changes text or flags, wherever the script keeps them.
    fn write_script(
        &self,
        object: impl FnOnce(&mut ScriptObject),
        detached: impl FnOnce(&mut Detached),
    ) -> ApiResult<()> {
        let script = self.script()?;
        match script.object {
            Some(handle) => {
                let change =
                    |o: &mut scene::Object| -> SceneResult<()> { o.script_mut().map(object) };
                self.sim
                    .scene
                    .borrow_mut()
                    .try_modify(handle, Field::Script, change)?;
            }
            None => detached(&mut script.detached.borrow_mut()),
        }
        Ok(())
    }

    fn priority(&self) -> ApiResult<ExecutionPriority> {
        let script = self.script()?;
        match script.object {
            Some(handle) => Ok(self.sim.scene.borrow().object(handle)?.priority),
            None => Ok(script.detached.borrow().priority),
        }
    }

    fn set_priority(&self, priority: ExecutionPriority) -> ApiResult<()> {
        let script = self.script()?;
        match script.object {
            Some(handle) => {
                self.sim
                    .scene
                    .borrow_mut()
                    .modify(handle, Field::Priority, |object| object.priority = priority)?;
            }
            None => {
                script.detached.borrow_mut().priority = priority;
                self.sim.scripts.forget_order();
            }
        }
        Ok(())
    }

    fn script_name(&self) -> ApiResult<String> {
        let script = self.script()?;
        match script.object {
            Some(handle) => Ok(self.sim.scene.borrow().object(handle)?.alias().to_owned()),
            None => Ok(script
                .detached
                .borrow()
                .name
                .trim_end_matches(ADD_ON_SUFFIX)
                .to_owned()),
        }
    }
}

pub(in crate::property) const SCRIPT: &[Accessor] = subject_properties! {
    "scriptDisabled": bool, |s| s.read_script(|o| o.disabled, |d| d.disabled)?,
        |s, on| s.write_script(|o| o.disabled = on, |d| d.disabled = on)?;
    "restartOnError": bool, |s| s.read_script(|o| o.restart_on_error, |d| d.restart_on_error)?,
        |s, on| s.write_script(|o| o.restart_on_error = on, |d| d.restart_on_error = on)?;
    "execPriority": i64, |s| s.priority()?.number(),
        |s, priority| s.set_priority(ExecutionPriority::from_number(priority))?;
    "scriptType": i64, |s| s.script()?.script_type as i64;
    "executionDepth": i64, |s| numbers::count(s.script()?.depth());
    "scriptState": i64, |s| s.script()?.state();
    "language": String, |s| s.read_script(|o| o.language.clone(), |d| d.language().to_owned())?;
    "code": super::Text, |s| super::Text(s.read_script(|o| o.code.clone(), |d| d.code.clone())?),
        |s, code| { let (text, copy) = (code.0.clone(), code.0); s.write_script(|o| (o.code, o.source) = (text, None), |d| (d.code, d.source) = (copy, None))? };
    "scriptName": String, |s| s.script_name()?;
    "addOnPath": String, |s| s.read_script(|_| String::new(), |d| d.path.clone())?;
    "addOnMenuPath": String, |s| s.read_script(|_| String::new(), |_| String::new())?;
};

pub(in crate::property) const SCRIPT_OBJECT: &[Accessor] = object_properties! {
    "scriptSize": f64, |o| o.script()?.size, Appearance |o, size| o.script_mut()?.size = size;
    "resetAfterSimError": bool, |o| o.script()?.reset_after_sim_error,
        Other |o, on| o.script_mut()?.reset_after_sim_error = on;
};
