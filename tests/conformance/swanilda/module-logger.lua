-- topic: modules
-- as: sandbox
-- passes: 0
-- note: log lines with levels
require 'logger'
log('info', 'one %d', 1)
log('debug', 'two')
log('error', '100%')
setloglevel('warning')
log('info', 'three')
log(sim.verbosity_scriptwarnings, 'four')
setloglevel('debug')
log('warning', '%s', 'five')
print(pcall(log, 'loud', 'x'))
