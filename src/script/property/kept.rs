//! Properties that are only kept: reading and writing them.

use super::{Sim, Target};
use crate::scene::{Data, Field};
use crate::script::error::{ApiError, ApiResult};

impl Sim {
    /// A kept value; None while nobody set it.
    pub(super) fn read_kept(&self, target: &Target, name: &str) -> ApiResult<Option<Data>> {
        match target {
            Target::App => Ok(self.app.borrow().kept.get(name).cloned()),
            Target::Scene => Ok(self.scene.borrow().kept(None, name)?.cloned()),
            Target::Object(handle) => Ok(self.scene.borrow().kept(Some(*handle), name)?.cloned()),
            Target::Mesh(uid) => self.with_mesh(*uid, |_, part| part.kept.get(name).cloned()),
            Target::Script(_) => Ok(None),
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
            Target::Mesh(uid) => {
                let mut scene = self.scene.borrow_mut();
                scene
                    .modify_mesh(*uid, Field::Kept, |part| part.kept.set(name, value))
                    .ok_or(ApiError::NoSuchTarget)?;
            }
            Target::Script(_) => return Err(ApiError::PropertyNotWritable),
        }
        Ok(())
    }
}
