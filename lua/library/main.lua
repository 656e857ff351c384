require('defaultMainScript')
