//! Inert properties: stored and read back without effect.

use super::{Sim, Target};
use crate::scene::Data;
use crate::script::error::{ApiError, ApiResult};

impl Sim {
    /// An inert value; None if it was not set.
    pub(super) fn read_kept(&self, target: &Target, name: &str) -> ApiResult<Option<Data>> {
        match target {
            Target::App => Ok(self.app.borrow().kept.get(name).cloned()),
            Target::Scene => Ok(self.scene.borrow().kept(None, name)?.cloned()),
            Target::Object(handle) => Ok(self.scene.borrow().kept(Some(*handle), name)?.cloned()),
            Target::Mesh(_) | Target::Script(_) => Ok(None),
        }
    }

    /// Keeps a value.
    pub(super) fn write_kept(&self, target: &Target, name: &'static str, value: Data) -> ApiResult<()> {
        match target {
            Target::App => {
                self.app.borrow_mut().kept.set(name, value);
            }
            Target::Scene => self.scene.borrow_mut().keep(None, name, value)?,
            Target::Object(handle) => self.scene.borrow_mut().keep(Some(*handle), name, value)?,
            Target::Mesh(_) | Target::Script(_) => return Err(ApiError::PropertyNotWritable),
        }
        Ok(())
    }
}
