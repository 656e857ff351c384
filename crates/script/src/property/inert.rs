//! Inert properties: stored and read back without effect.

use super::{Sim, Target};
use crate::error::{ApiError, ApiResult};
use scene::Data;

impl Sim {
    /// An inert value; None if it was not set.
    pub(super) fn read_inert(&self, target: &Target, name: &str) -> ApiResult<Option<Data>> {
        match target {
            Target::App => Ok(self.app.borrow().inert.get(name).cloned()),
            Target::Scene => Ok(self.scene.borrow().inert_value(None, name)?.cloned()),
            Target::Object(handle) => Ok(self.scene.borrow().inert_value(Some(*handle), name)?.cloned()),
            Target::Mesh(_) | Target::Script(_) => Ok(None),
        }
    }

    /// Sets the value.
    pub(super) fn write_inert(&self, target: &Target, name: &'static str, value: Data) -> ApiResult<()> {
        match target {
            Target::App => {
                self.app.borrow_mut().inert.set(name, value);
            }
            Target::Scene => self.scene.borrow_mut().set_inert_value(None, name, value)?,
            Target::Object(handle) => self.scene.borrow_mut().set_inert_value(Some(*handle), name, value)?,
            Target::Mesh(_) | Target::Script(_) => return Err(ApiError::PropertyNotWritable),
        }
        Ok(())
    }
}
