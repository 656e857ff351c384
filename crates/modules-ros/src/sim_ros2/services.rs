//! Services: clients that wait for answers, and servers.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;
use std::time::Duration;

use api_macro::api;
use ros_interfaces::{Layout, Record, cdr};
use rtps::{Correlation, Qos};

use super::endpoint::{Endpoint, reply_to, request_of};
use super::names;
use super::node::{Entity, Running, add, get, node, running, shut_down};
use super::ros_values::{self, Style};
use super::{ApiError, ApiFn, Cx, Result, functions, interfaces};
use scene::Data;
use script::{ScriptCallback, ScriptFunction, Table};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    create_client,
    wait_for_service,
    call,
    shutdown_client,
    client_treat_u_int8_array_as_string,
    create_service,
    shutdown_service,
    service_treat_u_int8_array_as_string,
];

/// What the servers of standard simulation interfaces need (`lua/library/remote/ros2.lua`).
pub(super) const ANSWERED_LATER: &[ApiFn] =
    functions![create_service_answered_later, respond, matches];

/// Bytes of a compiled regular expression.
const MAX_EXPRESSION: usize = 1 << 20;
/// Answers that nobody asks for any more are left out.
const MAX_REPLIES: usize = 100;

/// One end of a service: what sends, and what receives.
pub(super) struct Client {
    pub(super) request: Arc<Layout>,
    pub(super) response: Arc<Layout>,
    requests: Endpoint,
    replies: Endpoint,
    /// Distinguishes it from other clients.
    id: u64,
    style: Cell<Style>,
    /// Answers to earlier requests that were not asked for yet.
    arrived: RefCell<BTreeMap<i64, Vec<u8>>>,
}

impl Client {
    /// `full` is the name as all nodes know it.
    pub(super) fn new(
        running: &Rc<Running>,
        full: &str,
        [request, response]: [Arc<Layout>; 2],
    ) -> Self {
        let [to_server, from_server] = names::service(full);
        let replies = Endpoint::reader(running, &from_server, &response, Qos::default());
        let requests = Endpoint::writer(running, &to_server, &request, Qos::default());
        let guid = requests.guid().to_bytes();
        // The end of the participant's name and the entity: 8 bytes that no other client has.
        let id = guid[8..]
            .iter()
            .chain(&guid[2..6])
            .fold(0u64, |id, byte| id.rotate_left(8) ^ u64::from(*byte));
        Self {
            request,
            response,
            requests,
            replies,
            id,
            style: Cell::default(),
            arrived: RefCell::default(),
        }
    }

    pub(super) fn has_server(&self) -> bool {
        let tape = &self.requests.node.tape;
        let answer = tape.input("whether a service of ROS 2 is there", || {
            self.requests.has_partner(&self.replies)
        });
        answer.unwrap_or_default()
    }

    /// Sends a request. Returns its number.
    pub(super) fn send(&self, request: &Record) -> i64 {
        self.requests.request(request, &self.replies, self.id)
    }

    /// The answer to a request, if it has come.
    ///
    /// # Errors
    /// When it cannot be read.
    pub(super) fn answer(&self, number: i64) -> Option<Result<Record>> {
        let own = [self.replies.guid(), self.requests.guid()];
        let mut arrived = self.arrived.borrow_mut();
        while let Some(sample) = self.replies.take() {
            if let Some((number, payload)) = reply_to(sample, own, self.id) {
                arrived.insert(number, payload);
            }
        }
        while arrived.len() > MAX_REPLIES {
            arrived.pop_first();
        }
        let payload = arrived.remove(&number)?;
        Some(
            cdr::decode(&self.response, &payload)
                .map_err(|error| ApiError::Other(error.to_string())),
        )
    }
}

/// The other end: what receives requests, and what sends replies.
pub(super) struct Server {
    pub(super) request: Arc<Layout>,
    pub(super) response: Arc<Layout>,
    requests: Endpoint,
    replies: Endpoint,
}

impl Server {
    /// `full` is the name as all nodes know it.
    pub(super) fn new(
        running: &Rc<Running>,
        full: &str,
        [request, response]: [Arc<Layout>; 2],
    ) -> Self {
        let [to_server, from_server] = names::service(full);
        let replies = Endpoint::writer(running, &from_server, &response, Qos::default());
        let requests = Endpoint::reader(running, &to_server, &request, Qos::default());
        Self {
            request,
            response,
            requests,
            replies,
        }
    }

    /// The requests that have arrived. What cannot be read is left out: its client is none of this service.
    pub(super) fn arrived(&self) -> Vec<(Correlation, Record)> {
        let samples = (0..self.requests.waiting()).map_while(|_| self.requests.take());
        let requests = samples.filter_map(|sample| {
            let (call, payload) = request_of(sample)?;
            Some((call, cdr::decode(&self.request, &payload).ok()?))
        });
        requests.collect()
    }

    pub(super) fn reply(&self, call: Correlation, response: &Record) {
        self.replies.write(response, Some(call));
    }
}

/// A server with a script's function.
pub(super) struct Service {
    server: Server,
    callback: ScriptCallback,
    style: Cell<Style>,
    /// None where the function returns the response.
    unanswered: Option<Unanswered>,
}

/// Requests of a service whose responses come after its function has returned, by number.
#[derive(Default)]
struct Unanswered {
    last: Cell<i64>,
    calls: RefCell<BTreeMap<i64, Correlation>>,
}

impl Unanswered {
    /// The number of a request; the oldest one gets no response any more when there are many.
    fn add(&self, call: Correlation) -> i64 {
        let number = self.last.get() + 1;
        self.last.set(number);
        let mut calls = self.calls.borrow_mut();
        calls.insert(number, call);
        while calls.len() > MAX_REPLIES {
            calls.pop_first();
        }
        number
    }
}

impl Service {
    /// Calls back for each request, and sends what the function returns. No reply is sent when it fails.
    pub(super) fn spin(&self) {
        for (call, request) in self.server.arrived() {
            let request = ros_values::to_data(&request, self.style.get());
            if let Some(unanswered) = &self.unanswered {
                let number = Data::Int(unanswered.add(call));
                self.callback.call_logged(&[request, number]);
            } else if let Some(results) = self.callback.call_logged(&[request]) {
                let response = results.into_iter().next().unwrap_or(Data::Nil);
                self.reply(call, &response);
            }
        }
    }

    fn reply(&self, call: Correlation, response: &Data) {
        match ros_values::from_data(&self.server.response, response, self.style.get()) {
            Ok(response) => self.server.reply(call, &response),
            Err(problem) => self.callback.warn(&format!(
                "the response of a service was not sent: {problem}"
            )),
        }
    }
}

fn client(entity: Entity) -> Option<Rc<Client>> {
    match entity {
        Entity::Client(client) => Some(client),
        _ => None,
    }
}

fn service(entity: Entity) -> Option<Rc<Service>> {
    match entity {
        Entity::Service(service) => Some(service),
        _ => None,
    }
}

/// Creates a client of a service.
///
/// @param serviceName `/x`, `x` in the node's namespace, or `~/x` below the node
/// @param serviceType `pkg/srv/Name`
/// @return clientHandle it ends with the script
#[api("simROS2.createClient")]
fn create_client(cx: &mut Cx, service_name: String, service_type: String) -> Result<String> {
    let layouts = interfaces::service(cx, &service_type)?;
    let running = running(cx)?;
    let client = Client::new(&running, &running.resolve(&service_name)?, layouts);
    Ok(add(cx, Entity::Client(Rc::new(client))))
}

/// Waits until a service has a server.
///
/// @param clientHandle the client
/// @param timeout seconds; negative without limit
/// @return result whether there is a server
#[api("simROS2.waitForService")]
fn wait_for_service(cx: &mut Cx, client_handle: String, timeout: f64) -> Result<bool> {
    let client = get(cx, &client_handle, client)?;
    let limit = if timeout.is_nan() {
        Some(Duration::ZERO)
    } else {
        Duration::try_from_secs_f64(timeout).ok()
    };
    Ok(cx
        .wait_for(limit, || client.has_server().then_some(()))?
        .is_some())
}

/// Calls a service and waits for its answer. Callbacks run in the meantime.
///
/// @param clientHandle the client
/// @param request a table with the fields of the request
/// @return result a table with the fields of the response
#[api("simROS2.call")]
fn call(cx: &mut Cx, client_handle: String, request: Table) -> Result<Data> {
    let client = get(cx, &client_handle, client)?;
    let request = ros_values::from_data(&client.request, &request.0, client.style.get())
        .map_err(ApiError::Other)?;
    let response = ask(cx, &client, &request)?;
    Ok(ros_values::to_data(&response, client.style.get()))
}

/// Waits for a server that is being found, then for its answer.
pub(super) fn ask(cx: &Cx, client: &Client, request: &Record) -> Result<Record> {
    let node = node(cx);
    cx.wait_for(None, || {
        node.spin();
        client.has_server().then_some(())
    })?;
    let number = client.send(request);
    let answer = cx.wait_for(None, || {
        node.spin();
        client.answer(number)
    })?;
    answer.ok_or(ApiError::Interrupted)?
}

/// Ends a client.
///
/// @param clientHandle the client
#[api("simROS2.shutdownClient")]
fn shutdown_client(cx: &mut Cx, client_handle: String) -> Result<()> {
    shut_down(cx, &client_handle, client)
}

/// From now on fields of type `uint8[]` are strings.
///
/// @param clientHandle the client
#[api("simROS2.clientTreatUInt8ArrayAsString")]
fn client_treat_u_int8_array_as_string(cx: &mut Cx, client_handle: String) -> Result<()> {
    get(cx, &client_handle, client)?.style.set(Style {
        bytes_as_strings: true,
    });
    Ok(())
}

/// Creates a server of a service. The callback gets the request as a table and returns the response.
///
/// @param serviceName `/x`, `x` in the node's namespace, or `~/x` below the node
/// @param serviceType `pkg/srv/Name`
/// @param serviceCallback a function, or the name of a global one
/// @return serviceHandle it ends with the script
#[api("simROS2.createService")]
fn create_service(
    cx: &mut Cx,
    service_name: String,
    service_type: String,
    service_callback: ScriptFunction,
) -> Result<String> {
    add_service(cx, &service_name, &service_type, service_callback, None)
}

fn add_service(
    cx: &mut Cx,
    name: &str,
    service_type: &str,
    callback: ScriptFunction,
    unanswered: Option<Unanswered>,
) -> Result<String> {
    let layouts = interfaces::service(cx, service_type)?;
    let running = running(cx)?;
    let server = Server::new(&running, &running.resolve(name)?, layouts);
    let service = Service {
        server,
        callback: ScriptCallback::new(cx, callback),
        style: Cell::default(),
        unanswered,
    };
    Ok(add(cx, Entity::Service(Rc::new(service))))
}

/// Creates a server of a service whose responses come later. The callback gets the request as a table, and its number.
///
/// @param serviceName as for simROS2.createService
/// @param serviceType `pkg/srv/Name`
/// @param callback a function
/// @return serviceHandle it ends with the script
#[api("remote.ros2.createService")]
fn create_service_answered_later(
    cx: &mut Cx,
    service_name: String,
    service_type: String,
    callback: ScriptFunction,
) -> Result<String> {
    let unanswered = Some(Unanswered::default());
    add_service(cx, &service_name, &service_type, callback, unanswered)
}

/// Sends the response to a request, once.
///
/// @param serviceHandle the server
/// @param number of the request
/// @param response a table with the fields of the response
#[api("remote.ros2.respond")]
fn respond(cx: &mut Cx, service_handle: String, number: i64, response: Table) -> Result<()> {
    let service = get(cx, &service_handle, service)?;
    let calls = service
        .unanswered
        .as_ref()
        .map(|unanswered| &unanswered.calls);
    if let Some(call) = calls.and_then(|calls| calls.borrow_mut().remove(&number)) {
        service.reply(call, &without_empty_texts(response.0));
    }
    Ok(())
}

/// Fields with an empty text are left out, which means the same: simROS2 refuses them, as the original does.
pub(super) fn without_empty_texts(data: Data) -> Data {
    match data {
        Data::Map(entries) => {
            let is_kept = |value: &Data| !matches!(value, Data::Text(text) if text.is_empty());
            let kept = entries.into_iter().filter(|(_, value)| is_kept(value));
            Data::Map(
                kept.map(|(key, value)| (key, without_empty_texts(value)))
                    .collect(),
            )
        }
        Data::Array(items) => Data::Array(items.into_iter().map(without_empty_texts).collect()),
        other => other,
    }
}

/// Whether a regular expression matches somewhere in a text.
///
/// @param expression extended regular expression
/// @param text the text
/// @return matches nil where the expression is none
#[api("remote.ros2.matches")]
fn matches(_cx: &Cx, expression: String, text: String) -> Result<Option<bool>> {
    let compiled = regex::RegexBuilder::new(&expression)
        .size_limit(MAX_EXPRESSION)
        .build();
    Ok(compiled.ok().map(|compiled| compiled.is_match(&text)))
}

/// Ends a server of a service.
///
/// @param serviceHandle the server
#[api("simROS2.shutdownService")]
fn shutdown_service(cx: &mut Cx, service_handle: String) -> Result<()> {
    shut_down(cx, &service_handle, service)
}

/// From now on fields of type `uint8[]` are strings.
///
/// @param serviceHandle the server
#[api("simROS2.serviceTreatUInt8ArrayAsString")]
fn service_treat_u_int8_array_as_string(cx: &mut Cx, service_handle: String) -> Result<()> {
    get(cx, &service_handle, service)?.style.set(Style {
        bytes_as_strings: true,
    });
    Ok(())
}
