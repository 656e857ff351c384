//! What answers in place of a master that is not there: nobody else publishes, subscribes or offers a service, and parameters are those that the
//! node has set itself.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use crate::XmlRpcValue;

/// The parameters of a node without a master, by full name.
#[derive(Default)]
pub(crate) struct Offline {
    parameters: Mutex<BTreeMap<String, XmlRpcValue>>,
}

impl Offline {
    /// Answers a call of the master by `caller`.
    ///
    /// # Errors
    /// The master's explanation, where it would refuse.
    pub(crate) fn answer(
        &self,
        caller: &str,
        method: &str,
        arguments: Vec<XmlRpcValue>,
    ) -> Result<XmlRpcValue, String> {
        let mut parameters = self
            .parameters
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        let mut arguments = arguments.into_iter();
        let first = arguments.next();
        let name = first
            .as_ref()
            .and_then(XmlRpcValue::as_text)
            .unwrap_or_default();
        let unset = || format!("Parameter [{name}] is not set");
        match method {
            "setParam" => {
                if let Some(value) = arguments.next() {
                    parameters.insert(name.to_owned(), value);
                }
                Ok(XmlRpcValue::Int(0))
            }
            "getParam" => parameters.get(name).cloned().ok_or_else(unset),
            "hasParam" => Ok(XmlRpcValue::Bool(parameters.contains_key(name))),
            "deleteParam" => {
                let removed = parameters.remove(name);
                removed.map(|_| XmlRpcValue::Int(0)).ok_or_else(unset)
            }
            "searchParam" => search(&parameters, caller, name).ok_or_else(unset),
            "lookupService" => Err("no provider".to_owned()),
            _ => Ok(XmlRpcValue::Array(Vec::new())),
        }
    }
}

/// The full name in the innermost namespace that has it.
fn search(
    parameters: &BTreeMap<String, XmlRpcValue>,
    caller: &str,
    name: &str,
) -> Option<XmlRpcValue> {
    let mut namespace = caller;
    loop {
        let full = format!("{namespace}/{name}");
        if parameters.contains_key(&full) {
            return Some(XmlRpcValue::String(full));
        }
        namespace = namespace.rsplit_once('/')?.0;
    }
}
