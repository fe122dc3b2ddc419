/* Marks what the library offers to others: a shared library shows nothing else. */
#ifndef CNCTRANS_EXPORT_H
#define CNCTRANS_EXPORT_H

#if defined(_WIN32)
#define CNCTRANS_API
#else
#define CNCTRANS_API __attribute__((visibility("default")))
#endif

#endif
