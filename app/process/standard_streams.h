// Standard input, output and error as the program finds them: open, closed, a pipe that nobody
// reads any more, a device that is full.
#ifndef HOWL_APP_PROCESS_STANDARD_STREAMS_H_
#define HOWL_APP_PROCESS_STANDARD_STREAMS_H_

namespace howl {

// To be called first. A stream that is closed is opened so that every use of it fails: else the
// next file that is opened would take its place, and what is printed would go into that file.
// Neither a reader that has gone nor a file that may grow no more ends the program, which has files
// to finish.
void SecureStandardStreams();

// A full disk behind standard output must not pass for an answer that was given: throws UserError.
// Where the reader of a pipe has gone, ends the program as that ends any other: it wanted no more.
void FlushOutput();

}  // namespace howl

#endif  // HOWL_APP_PROCESS_STANDARD_STREAMS_H_
