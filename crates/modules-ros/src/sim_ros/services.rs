//! Services: clients and servers.

use std::cell::Cell;
use std::rc::Rc;
use std::sync::Arc;

use api_macro::api;
use ros_interfaces::{Layout, Record};
use ros1::ServiceType;

use super::network::Server;
use super::node::{Entity, add, get, node, running, service, service_type, shut_down};
use super::ros_values::{self, Style};
use super::{ApiError, ApiFn, Cx, Result, failed, functions};
use scene::Data;
use script::{ScriptCallback, ScriptFunction, Table};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    service_client,
    call,
    shutdown_service_client,
    service_client_treat_u_int8_array_as_string,
    advertise_service,
    shutdown_service_server,
    service_server_treat_u_int8_array_as_string,
];

/// What calls a service.
pub(super) struct Client {
    name: String,
    service_type: ServiceType,
    layouts: [Arc<Layout>; 2],
    style: Cell<Style>,
}

/// A server with a script's function.
pub(super) struct Service {
    server: Server,
    layouts: [Arc<Layout>; 2],
    callback: ScriptCallback,
    style: Cell<Style>,
}

impl Service {
    /// Calls back for the requests that have arrived, and answers what the function returns.
    pub(super) fn spin(&self) {
        while let Some(request) = self.server.take() {
            let answer = self.answer(&request.bytes);
            if let Err(problem) = &answer {
                self.callback
                    .warn(&format!("simROS: a service failed: {problem}"));
            }
            request.answer(answer);
        }
    }

    fn answer(&self, bytes: &[u8]) -> std::result::Result<Vec<u8>, String> {
        let [request, response] = &self.layouts;
        let request =
            ros_interfaces::ros1::decode(request, bytes).map_err(|error| error.to_string())?;
        let results = self
            .callback
            .call_logged(&[ros_values::to_data(&request, self.style.get())]);
        let result = results
            .ok_or("the script's function failed")?
            .into_iter()
            .next()
            .unwrap_or(Data::Nil);
        let response = match result {
            // A response without fields needs no table.
            Data::Nil if response.fields.is_empty() => Record::new(response),
            result => ros_values::from_data(response, &result, self.style.get())?,
        };
        Ok(ros_interfaces::ros1::encode(&response))
    }
}

fn client(entity: Entity) -> Option<Rc<Client>> {
    match entity {
        Entity::Client(client) => Some(client),
        _ => None,
    }
}

fn server(entity: Entity) -> Option<Rc<Service>> {
    match entity {
        Entity::Service(service) => Some(service),
        _ => None,
    }
}

/// Creates a client of a service. The service is looked up at each call.
///
/// @param serviceName `/x`, `x` in the node's namespace, or `~x` below the node
/// @param serviceType `pkg/Name`
/// @return serviceClientHandle it ends with the script
#[api("simROS.serviceClient")]
fn service_client(cx: &mut Cx, service_name: String, service_type: String) -> Result<String> {
    let layouts = service(cx, &service_type)?;
    running(cx)?;
    let service_type = self::service_type(&service_type, &layouts);
    let client = Client {
        name: service_name,
        service_type,
        layouts,
        style: Cell::default(),
    };
    Ok(add(cx, Entity::Client(Rc::new(client))))
}

/// Calls a service and waits for its answer. Callbacks run in the meantime.
///
/// @param serviceClientHandle the client
/// @param request a table with the fields of the request
/// @return result a table with the fields of the response; nil without a master
#[api("simROS.call")]
fn call(cx: &mut Cx, service_client_handle: String, request: Table) -> Result<Data> {
    let client = get(cx, &service_client_handle, client)?;
    let [request_layout, response_layout] = &client.layouts;
    let request = ros_values::from_data(request_layout, &request.0, client.style.get())
        .map_err(ApiError::Other)?;
    let bytes = ros_interfaces::ros1::encode(&request);
    let running = running(cx)?;
    if running.node.has_no_master() {
        return Ok(Data::Nil);
    }
    let call = running
        .node
        .call(&client.name, &client.service_type, bytes)
        .map_err(|error| failed(&error))?;
    let node = node(cx);
    let answer = cx.wait_for(None, || {
        node.spin();
        call.poll()
    })?;
    let answer = answer.ok_or(ApiError::Interrupted)?;
    let answer = answer.map_err(|error| {
        ApiError::Other(format!("call of service '{}' failed: {error}", client.name))
    })?;
    let response = ros_interfaces::ros1::decode(response_layout, &answer);
    let response = response.map_err(|error| {
        ApiError::Other(format!("response of service '{}': {error}", client.name))
    })?;
    Ok(ros_values::to_data(&response, client.style.get()))
}

/// Ends a client.
///
/// @param serviceClientHandle the client
#[api("simROS.shutdownServiceClient")]
fn shutdown_service_client(cx: &mut Cx, service_client_handle: String) -> Result<()> {
    shut_down(cx, &service_client_handle, client)
}

/// From now on fields of type `uint8[]` are strings.
///
/// @param serviceClientHandle the client
#[api("simROS.serviceClientTreatUInt8ArrayAsString")]
fn service_client_treat_u_int8_array_as_string(
    cx: &mut Cx,
    service_client_handle: String,
) -> Result<()> {
    get(cx, &service_client_handle, client)?.style.set(Style {
        bytes_as_strings: true,
    });
    Ok(())
}

/// Offers a service. The callback gets the request as a table and returns the response.
///
/// @param serviceName `/x`, `x` in the node's namespace, or `~x` below the node
/// @param serviceType `pkg/Name`
/// @param serviceCallback a function, or the name of a global one
/// @return serviceServerHandle it ends with the script
#[api("simROS.advertiseService")]
fn advertise_service(
    cx: &mut Cx,
    service_name: String,
    service_type: String,
    service_callback: ScriptFunction,
) -> Result<String> {
    let layouts = service(cx, &service_type)?;
    let service_type = self::service_type(&service_type, &layouts);
    let server = running(cx)?
        .node
        .offer(&service_name, &service_type)
        .map_err(|error| failed(&error))?;
    let callback = ScriptCallback::new(cx, service_callback);
    Ok(add(
        cx,
        Entity::Service(Rc::new(Service {
            server,
            layouts,
            callback,
            style: Cell::default(),
        })),
    ))
}

/// Ends a service.
///
/// @param serviceServerHandle the service
#[api("simROS.shutdownServiceServer")]
fn shutdown_service_server(cx: &mut Cx, service_server_handle: String) -> Result<()> {
    shut_down(cx, &service_server_handle, server)
}

/// From now on fields of type `uint8[]` are strings.
///
/// @param serviceServerHandle the service
#[api("simROS.serviceServerTreatUInt8ArrayAsString")]
fn service_server_treat_u_int8_array_as_string(
    cx: &mut Cx,
    service_server_handle: String,
) -> Result<()> {
    get(cx, &service_server_handle, server)?.style.set(Style {
        bytes_as_strings: true,
    });
    Ok(())
}
