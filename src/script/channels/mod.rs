//! Communication channels of scripts: tubes, WebSocket endpoints, semaphores.

pub(in crate::script) mod system_semaphore;
pub(in crate::script) mod tubes;
pub(in crate::script) mod web_socket_log;
pub(crate) mod web_sockets;
