//! Calls of the master.

use crate::network::{NodeNetwork, Place};
use crate::offline::Offline;
use crate::xmlrpc::{call_text, read_response};
use crate::{Error, Result, XmlRpcValue, http, limits};

/// A master, as a node calls it.
pub(crate) struct Master {
    pub(crate) uri: String,
    place: Place,
    network: NodeNetwork,
    /// The name of the node.
    pub(crate) caller: String,
    /// What answers in its place.
    offline: Option<Offline>,
}

impl Master {
    pub(crate) fn new(uri: &str, network: NodeNetwork, caller: &str) -> Result<Self> {
        Ok(Self {
            uri: uri.into(),
            place: Place::parse(uri, "http")?,
            network,
            caller: caller.into(),
            offline: None,
        })
    }

    /// One that is never asked.
    pub(crate) fn absent(self) -> Self {
        Self {
            network: NodeNetwork::Loopback,
            offline: Some(Offline::default()),
            ..self
        }
    }

    pub(crate) fn is_absent(&self) -> bool {
        self.offline.is_some()
    }

    pub(crate) fn place(&self) -> &Place {
        &self.place
    }

    /// Calls a method in the name of the node.
    pub(crate) fn call(&self, method: &str, arguments: &[&str]) -> Result<XmlRpcValue> {
        self.call_with(
            method,
            arguments
                .iter()
                .map(|text| XmlRpcValue::text(text))
                .collect(),
        )
    }

    pub(crate) fn call_with(
        &self,
        method: &str,
        mut arguments: Vec<XmlRpcValue>,
    ) -> Result<XmlRpcValue> {
        let refused = |reason| Error::Refused {
            method: method.into(),
            reason,
        };
        if let Some(offline) = &self.offline {
            return offline
                .answer(&self.caller, method, arguments)
                .map_err(refused);
        }
        arguments.insert(0, XmlRpcValue::text(&self.caller));
        let answer = http::post(
            self.network,
            &self.place,
            &call_text(method, &arguments),
            limits::TIMEOUT,
        )
        .map_err(|error| Error::Master {
            uri: self.uri.clone(),
            problem: error.to_string(),
        })?;
        value_of(read_response(&answer)?).map_err(refused)
    }
}

/// The value of an answer, which is status, explanation and value.
///
/// # Errors
/// The explanation, if the status is not 1.
pub(crate) fn value_of(answer: XmlRpcValue) -> std::result::Result<XmlRpcValue, String> {
    let XmlRpcValue::Array(parts) = answer else {
        return Err("an answer without status".into());
    };
    let mut parts = parts.into_iter();
    let (status, explanation, value) = (parts.next(), parts.next(), parts.next());
    match (status, value) {
        (Some(XmlRpcValue::Int(1)), Some(value)) => Ok(value),
        _ => Err(explanation
            .and_then(|text| text.as_text().map(String::from))
            .unwrap_or_else(|| "no reason".into())),
    }
}
